"""Fetches by Maven the missing jars of jars.list's groups, and checks their sums.

``fetch.py FOLDER GROUP...``: every jar has its coordinates and its SHA-256 in jars.list; one that
differs is removed. ``--offline`` as Maven's own; ``--list`` only prints the file names. Exits with
1 for a wrong jar or list, and reports the code ``fetch_failed`` if Maven brought none.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

LIST = Path(__file__).resolve().parent.parent / "jars.list"
PLUGIN = "org.apache.maven.plugins:maven-dependency-plugin:3.6.1"
PACKAGES = "maven default-jdk-headless"
LONGEST_REASON = 300
# A run this short gains nothing from the second compiler of the JVM.
QUICK = {"MAVEN_OPTS": "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"}
PROGRESS = re.compile(r"(Downloading|Downloaded) from \S+ \S+/([^/\s]+\.jar)(?: \(([^)]+)\))?")
POM = """<project xmlns="http://maven.apache.org/POM/4.0.0">
<modelVersion>4.0.0</modelVersion>
<groupId>org.raspilot</groupId><artifactId>jars</artifactId><version>1</version>
<packaging>pom</packaging>
<build><plugins><plugin>{plugin}<configuration><outputDirectory>{folder}</outputDirectory>
<artifactItems>{items}</artifactItems></configuration></plugin></plugins></build>
</project>
"""


class FetchError(Exception):
    """Jars are missing or wrong: the message is one sentence."""


class Jar(NamedTuple):
    """One jar of the list: its Maven coordinates and its SHA-256."""

    group: str
    artifact: str
    version: str
    kind: str
    sha256: str

    @property
    def name(self) -> str:
        return f"{self.artifact}-{self.version}.{self.kind}"


def groups(listed: Path) -> dict[str, list[Jar]]:
    """Return the jars of every group of a list, in its order. Raises ``FetchError``."""
    found: dict[str, list[Jar]] = {}
    for number, line in enumerate(listed.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split("#", 1)[0].replace(":", " ").split()
        if len(words) == 1:
            found[words[0].strip("[]")] = []
        elif len(words) == 5 and found:
            found[list(found)[-1]].append(Jar(*words))
        elif words:
            raise FetchError(f"{listed.name}:{number}: a jar is GROUP:ARTIFACT:VERSION:TYPE SHA256")
    return found


def check(file: Path, jar: Jar, source: str) -> None:
    """Raise ``FetchError`` unless ``file`` has its listed sum; remove it then."""
    with file.open("rb") as opened:
        digest = hashlib.file_digest(opened, "sha256").hexdigest()
    if digest != jar.sha256:
        file.unlink()
        raise FetchError(
            f"{file.name} is not what it should be: its SHA-256 is {digest}, "
            f"{source} has {jar.sha256}; it was removed"
        )


def fetch(folder: Path, wanted: list[str], listed: Path, options: list[str]) -> None:
    """Fetch every missing jar of the groups ``wanted`` into ``folder``, and check its sum.

    Raises ``FetchError``.
    """
    known = groups(listed)
    folder.mkdir(parents=True, exist_ok=True)
    for group in wanted:
        if group not in known:
            raise FetchError(f"{listed.name} has no group {group!r}: it has {', '.join(known)}")
    jars = list(dict.fromkeys(jar for group in wanted for jar in known[group]))
    missing = [jar for jar in jars if not (folder / jar.name).is_file()]
    if missing:
        lacking = " ".join(group for group in wanted if not set(missing).isdisjoint(known[group]))
        print(f"fetch {lacking}: {len(missing)} jars by Maven", flush=True)
        # Maven's files appear complete or not at all.
        with tempfile.TemporaryDirectory(dir=folder, prefix=".new-") as work:
            maven(lacking, missing, Path(work), options)
            for jar in missing:
                if not (Path(work) / jar.name).is_file():
                    raise FetchError(f"Maven did not bring {jar.name}")
                check(Path(work) / jar.name, jar, listed.name)
                (Path(work) / jar.name).replace(folder / jar.name)
    for jar in jars:
        check(folder / jar.name, jar, listed.name)


def maven(lacking: str, jars: list[Jar], folder: Path, options: list[str]) -> None:
    """Let Maven copy jars into ``folder``; print their names during that."""
    program = shutil.which("mvn")
    if program is None:
        raise FetchError(f"fetching jars needs mvn (Debian packages {PACKAGES})")
    pom = folder / "pom.xml"
    pom.write_text(POM.format(
        plugin=element(groupId=PLUGIN.split(":")[0], artifactId=PLUGIN.split(":")[1]),
        folder=folder.resolve(),
        items="".join(
            "<artifactItem>" + element(
                groupId=jar.group, artifactId=jar.artifact, version=jar.version, type=jar.kind
            ) + "</artifactItem>"
            for jar in jars
        ),
    ))  # fmt: skip
    command = [program, "-B", *options, "-f", str(pom), f"{PLUGIN}:copy"]
    names = {jar.name for jar in jars}
    errors = []
    last = ""
    told = False
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=QUICK | os.environ,
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
        raise FetchError(f"Maven could not fetch the jars of {lacking}: {said} (fetch_failed)")


def element(**texts: str) -> str:
    """Return one XML element of each text."""
    return "".join(f"<{name}>{text}</{name}>" for name, text in texts.items())


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
    try:
        if "--list" in options:
            print(*(jar.name for group in wanted for jar in groups(LIST)[group]))
        else:
            fetch(Path(folder), wanted, LIST, options)
    except FetchError as failure:
        print(f"android: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
