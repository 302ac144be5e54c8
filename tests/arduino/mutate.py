"""Take each safety rule out of a copy of the firmware and demand that its test fails.

``python -m tests.arduino.mutate [words]`` runs the entries of ``mutations.yml`` whose rule or test
contains the words, and exits 1 when a test still passes, or when it fails without the mutation.
"""

from __future__ import annotations

import concurrent.futures
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
TESTS = Path(__file__).parent
WORKERS = min(2, os.cpu_count() or 1)
MOST_S = 600


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


def copy_of_the_firmware(folder: Path) -> Path:
    """Copy what the build needs; returns the copied ``arduino`` folder."""
    arduino = folder / "arduino"
    shutil.copytree(
        ROOT / "arduino", arduino, ignore=shutil.ignore_patterns("build*", "__pycache__", "corpus")
    )
    return arduino


def build(arduino: Path) -> Path:
    """Return the ELF of a folder; raises ``ValueError`` when it does not compile."""
    elf = arduino / "build" / "raspilot.elf"
    done = subprocess.run(
        ["make", "-C", str(arduino), "build/raspilot.elf"],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise ValueError(f"does not compile: {done.stderr.strip().splitlines()[-1]}")
    return elf


def passes(elf: Path, tests: list[str]) -> bool:
    """Return whether tests pass with an ELF; raises ``ValueError`` when no tests were found."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "--no-header", "-p", "no:cacheprovider"]
    done = subprocess.run(
        [*command, *(f"tests/arduino/{each}" for each in tests)],
        cwd=ROOT,
        env=os.environ | {"RASPILOT_ELF": str(elf)},
        capture_output=True,
        text=True,
        timeout=MOST_S,
        check=False,
    )
    if done.returncode not in (0, 1) or " error" in done.stdout.splitlines()[-1]:
        raise ValueError(f"did not run: {done.stdout.strip().splitlines()[-1]}")
    return done.returncode == 0


def judge(entry: dict) -> str:
    """Return the result of one mutation; ``caught`` is the wanted one."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            arduino = copy_of_the_firmware(Path(folder))
            apply(entry, arduino / "raspilot" / "src")
            return "NOT CAUGHT" if passes(build(arduino), [entry["test"]]) else "caught"
    except ValueError as error:
        return str(error)


def main() -> int:
    """Judge the entries that the words select."""
    words = " ".join(sys.argv[1:])
    chosen = [each for each in mutations() if words in each["rule"] or words in each["test"]]
    with tempfile.TemporaryDirectory() as folder:
        elf = build(copy_of_the_firmware(Path(folder)))
        if not chosen or not passes(elf, sorted({each["test"] for each in chosen})):
            print("the tests must pass before anything is taken out")
            return 1
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        for entry, result in zip(chosen, pool.map(judge, chosen), strict=True):
            wrong += result != "caught"
            print(f"{result}: {entry['rule']} ({entry['test']})", flush=True)
    print(f"{len(chosen)} rules, {wrong} not shown")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
