"""Take each safety rule out of a copy of the firmware and demand that its test fails.

``python -m tests.arduino.mutate [words]`` runs the entries of ``mutations.yml`` whose rule or test
contains the words, and exits 1 when a test still passes, or when it fails without the mutation.
"""

from __future__ import annotations

import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TESTS = Path(__file__).parent
HOST = "host/"
"""A test that begins with it is a test case of ``arduino/host``, built for this computer."""
WORKERS = min(2, os.cpu_count() or 1)
MAX_TEST_S = 600
_COPIED = shutil.ignore_patterns("build*", "__pycache__", "corpus")


def mutations() -> list[dict]:
    """Return the entries of the table."""
    return yaml.safe_load((TESTS / "mutations.yml").read_text(encoding="utf-8"))


def changes(entry: dict) -> list[tuple[str, str, str]]:
    """Return (file, find, replace) of everything that an entry takes out."""
    parts = [entry, *entry.get("with", [])]
    return [(each["file"], each["find"], each["replace"]) for each in parts]


def apply(entry: dict, source: Path) -> None:
    """Change the sources below a folder; raises ``ValueError`` when a text is not there once."""
    for name, find, replace in changes(entry):
        path = source / name
        text = path.read_text(encoding="utf-8")
        if text.count(find) != 1:
            raise ValueError(f"{name} has {find!r} {text.count(find)} times, not once")
        path.write_text(text.replace(find, replace), encoding="utf-8")


def make(arduino: Path, target: str, *options: str) -> Path:
    """Build a target in a copy of ``arduino``; raises ``ValueError`` when it does not compile."""
    done = _run(["make", "-C", str(arduino), target, *options])
    if done.returncode:
        raise ValueError(f"does not compile: {done.stderr.strip().splitlines()[-1]}")
    return arduino / target


def passes(arduino: Path, tests: list[str]) -> bool:
    """Return whether tests pass in a copy; raises ``ValueError`` for one that was not found."""
    on_host = [each for each in tests if each.startswith(HOST)]
    on_chip = [each for each in tests if each not in on_host]
    return all(_passes_on_host(arduino, each) for each in on_host) and (
        not on_chip or _passes_on_chip(arduino, on_chip)
    )


def _passes_on_host(arduino: Path, test: str) -> bool:
    # A mutation may leave a parameter unused.
    program = make(arduino, "build/host/tests", "WERROR=")
    # A comma separates filters.
    name = test.split("::")[1].replace(",", "?")
    done = _run([str(program), f"-tc={name}"])
    if re.search(r"test cases: +1 ", done.stdout) is None:
        raise ValueError(f"did not run: {test}")
    return done.returncode == 0


def _passes_on_chip(arduino: Path, tests: list[str]) -> bool:
    command = [sys.executable, "-m", "pytest", "-q", "-x", "--no-header", "-p", "no:cacheprovider"]
    command += [f"tests/arduino/{each}" for each in tests]
    done = _run(command, RASPILOT_ELF=str(make(arduino, "build/raspilot.elf")))
    if done.returncode not in (0, 1) or " error" in done.stdout.splitlines()[-1]:
        raise ValueError(f"did not run: {done.stdout.strip().splitlines()[-1]}")
    return done.returncode == 0


def _run(command: list[str], **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command,
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=MAX_TEST_S,
        check=False,
    )


def result_of(entry: dict, built: Path) -> str:
    """Return the result of one mutation; ``caught`` is the wanted one."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            # With the object files: only files that the mutation changes are compiled again.
            arduino = shutil.copytree(built, Path(folder) / "arduino")
            apply(entry, arduino / "raspilot" / "src")
            return "NOT CAUGHT" if passes(arduino, [entry["test"]]) else "caught"
    except ValueError as error:
        return str(error)


def main() -> int:
    """Run the entries that the words select."""
    words = " ".join(sys.argv[1:])
    chosen = [each for each in mutations() if words in each["rule"] or words in each["test"]]
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        built = shutil.copytree(ROOT / "arduino", Path(folder) / "arduino", ignore=_COPIED)
        if not chosen or not passes(built, sorted({each["test"] for each in chosen})):
            print("the tests must pass before anything is taken out")
            return 1
        with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
            results = pool.map(lambda entry: result_of(entry, built), chosen)
            for entry, result in zip(chosen, results, strict=True):
                wrong += result != "caught"
                print(f"{result}: {entry['rule']} ({entry['test']})", flush=True)
    print(f"{len(chosen)} rules, {wrong} not shown")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
