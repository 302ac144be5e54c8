"""Fetches by Maven the missing jars of pom.xml's groups, and checks their sums.

``fetch.py FOLDER GROUP...``: a group is an execution of pom.xml. Every jar must have its SHA-256 in
jars.sha256; one that differs is removed. ``--offline`` as Maven's own; ``--list`` only prints the
file names.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
POM = HERE / "pom.xml"
SUMS = HERE / "jars.sha256"
SPACE = "{http://maven.apache.org/POM/4.0.0}"
PLUGIN = "org.apache.maven.plugins:maven-dependency-plugin"
PACKAGES = "maven default-jdk-headless"
LONGEST_REASON = 300
PROGRESS = re.compile(r"(Downloading|Downloaded) from \S+ \S+/([^/\s]+\.jar)(?: \(([^)]+)\))?")


class FetchError(Exception):
    """Jars are missing or wrong: the message is one sentence."""


def groups(pom: Path) -> dict[str, list[str]]:
    """Return the file names of every group of ``pom``, in its order."""
    found: dict[str, list[str]] = {}
    for execution in ElementTree.parse(pom).iter(f"{SPACE}execution"):
        files = []
        for item in execution.iter(f"{SPACE}artifactItem"):
            text = {each.tag.removeprefix(SPACE): each.text or "" for each in item}
            classifier = f"-{text['classifier']}" if "classifier" in text else ""
            kind = text.get("type", "jar")
            files.append(f"{text['artifactId']}-{text['version']}{classifier}.{kind}")
        found[execution.findtext(f"{SPACE}id", "")] = files
    return found


def sums(listed: Path) -> dict[str, str]:
    """Return the SHA-256 of every file that ``listed`` names, as sha256sum writes them."""
    lines = listed.read_text(encoding="utf-8").splitlines()
    return {name: digest for digest, name in (line.split(maxsplit=1) for line in lines)}


def check(file: Path, expected: dict[str, str], source: str) -> None:
    """Raise ``FetchError`` unless ``file`` has its listed sum; remove it then."""
    if file.name not in expected:
        raise FetchError(f"{source} has no SHA-256 of {file.name}, which pom.xml names")
    with file.open("rb") as opened:
        digest = hashlib.file_digest(opened, "sha256").hexdigest()
    if digest != expected[file.name]:
        file.unlink()
        raise FetchError(
            f"{file.name} is not what it should be: its SHA-256 is {digest}, "
            f"{source} says {expected[file.name]}; it was removed"
        )


def fetch(folder: Path, wanted: list[str], pom: Path, listed: Path, options: list[str]) -> None:
    """Fetch every missing jar of the groups ``wanted`` into ``folder``, and check its sum.

    Raises ``FetchError``.
    """
    known = groups(pom)
    expected = sums(listed)
    folder.mkdir(parents=True, exist_ok=True)
    for group in wanted:
        if group not in known:
            raise FetchError(f"{pom.name} has no group {group!r}: it has {', '.join(known)}")
        missing = [name for name in known[group] if not (folder / name).is_file()]
        if missing:
            print(f"fetch {group}: {len(missing)} jars by Maven", flush=True)
            # Maven's files appear complete or not at all.
            with tempfile.TemporaryDirectory(dir=folder, prefix=".new-") as work:
                maven(group, known[group], Path(work), pom, options)
                for name in known[group]:
                    if not (Path(work) / name).is_file():
                        raise FetchError(f"Maven did not bring {name}")
                    check(Path(work) / name, expected, listed.name)
                    (Path(work) / name).replace(folder / name)
        else:
            for name in known[group]:
                check(folder / name, expected, listed.name)


def maven(group: str, names: list[str], folder: Path, pom: Path, options: list[str]) -> None:
    """Let Maven copy the jars of a group into ``folder``; print their names during that."""
    program = shutil.which("mvn")
    if program is None:
        raise FetchError(f"fetching jars needs mvn (Debian packages {PACKAGES})")
    command = [program, "-B", *options, "-f", str(pom), f"-Dmdep.outputDirectory={folder}"]
    command += ["-DoutputDirectory=" + str(folder), f"{PLUGIN}:copy@{group}"]
    errors = []
    last = ""
    told = False
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as running:
        assert running.stdout is not None
        for line in running.stdout:
            progress = PROGRESS.search(line)
            if progress and progress[2] in names:
                print(
                    f"  {progress[1].lower()} {progress[2]} {progress[3] or ''}".rstrip(),
                    flush=True,
                )
            elif progress and not told:
                print("  Maven fetches its own plugins first", flush=True)
                told = True
            if line.startswith("[ERROR]"):
                errors.append(line.removeprefix("[ERROR]").strip())
            last = line.strip() or last
    if running.returncode != 0:
        said = reason(errors) or last or f"exit status {running.returncode}"
        raise FetchError(f"Maven could not fetch the jars of {group}: {said}")


def reason(errors: list[str]) -> str:
    """Return the cause in Maven's error lines, or the file that it cannot read."""
    told = [each for each in errors if each]
    if not told:
        return ""
    # "Plugin p or one of its dependencies ...: Could not transfer artifact a from/to place
    # (address): cause -> [Help 1]": the words before the cause are irrelevant here.
    text = re.sub(r"\s*->\s*\[Help \d+\]$", "", told[0])
    if found := re.search(r".*from/to \S+ \([^)]*\): (.+)$", text):
        return re.sub(r"^transfer failed for \S+?(?: proxy: ProxyInfo\{.*?\})?: ", "", found[1])
    # "1 problem was encountered ...": the next line has the problem.
    if re.search(r"problems? w(?:as|ere) encountered", text) and len(told) > 1:
        return told[1]
    return text if len(text) <= LONGEST_REASON else f"{text[:LONGEST_REASON]} ..."


def main(arguments: list[str]) -> int:
    """Run with command line ``arguments``; return the exit status."""
    options = [each for each in arguments if each.startswith("-")]
    folder, *wanted = [each for each in arguments if not each.startswith("-")]
    if "--list" in options:
        print(*(name for group in wanted for name in groups(POM)[group]))
        return 0
    try:
        fetch(Path(folder), wanted, POM, SUMS, options)
    except FetchError as failure:
        print(f"android: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
