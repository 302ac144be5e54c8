"""Removes what each shipped scenario guards from a copy of the project: it must fail there.

``python -m tests.simulator.scenarios.mutate [NAME ...]`` prints the rows of docs/flights.md and
exits 1 when a scenario still holds.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

from tests.arduino.mutate import changes
from tests.arduino.mutate import mutations as firmware_mutations
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.run import SUMMARY
from up_simulator.verbs.catalogue import shipped_paths

ROOT = Path(__file__).resolve().parents[3]
FIRMWARE = "arduino/raspilot/src/"
LEFT_OUT = (".git", ".venv", "run", "node_modules", "__pycache__", ".mypy_cache", ".ruff_cache")
MAX_S = 300


def mutations() -> dict[str, list[tuple[str, str, str]]]:
    """Return (file, find, replace) of everything that is taken out, by scenario."""
    rules = {each["rule"]: each for each in firmware_mutations()}
    path = Path(__file__).with_name("mutations.yml")
    found = {}
    for entry in yaml.safe_load(path.read_text(encoding="utf-8")):
        if "firmware" in entry:
            parts = changes(rules[entry["firmware"]])
            found[entry["scenario"]] = [(f"{FIRMWARE}{name}", *rest) for name, *rest in parts]
        else:
            found[entry["scenario"]] = changes(entry)
    return found


def failure_of(name: str, root: Path) -> str:
    """Return the first expectation that did not hold when a tree flies a scenario, else ''."""
    # The packages of the copy come before those that are installed.
    packages = [*root.glob("*/*/__init__.py"), *root.glob("*/*/*/__init__.py")]
    parents = {path.parents[1] for path in packages}
    folders = [root, *sorted(each for each in parents if not (each / "__init__.py").is_file())]
    output = root / "run" / "flights"
    shutil.rmtree(output / name, ignore_errors=True)
    command = [sys.executable, "-m", "up_simulator.cli", "fly", name, "--no-picture", "--quiet"]
    done = subprocess.run(
        [*command, "--output", str(output)],
        cwd=root,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(map(str, folders))},
        capture_output=True,
        text=True,
        timeout=MAX_S,
        check=False,
    )
    summary = output / name / SUMMARY
    if not summary.is_file():
        raise ValueError(f"{name} was not flown: {(done.stderr or done.stdout).strip()[-300:]}")
    flown = json.loads(summary.read_text(encoding="utf-8"))
    if flown["failure"]:
        return str(flown["failure"])
    for verdict in flown["expectations"]:
        if not verdict["held"]:
            return f"{verdict['name']}: {verdict['figure']} ({verdict['limit']})"
    return ""


def judge(name: str, parts: list[tuple[str, str, str]], root: Path) -> str:
    """Return how a scenario failed without its rule; raises ``ValueError`` with a sentence."""
    kept = {each: (root / each).read_text(encoding="utf-8") for each, _, _ in parts}
    try:
        for each, find, replace in parts:
            text = (root / each).read_text(encoding="utf-8")
            if text.count(find) != 1:
                raise ValueError(f"{each} has {find!r} {text.count(find)} times, not once")
            (root / each).write_text(text.replace(find, replace), encoding="utf-8")
        return failure_of(name, root)
    finally:
        for each, text in kept.items():
            (root / each).write_text(text, encoding="utf-8")


def main() -> int:
    taken_out, wrong = mutations(), 0
    scenarios = {path.stem: read_scenario(path) for path in shipped_paths()}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder) / "copy"
        shutil.copytree(ROOT, root, ignore=shutil.ignore_patterns(*LEFT_OUT))
        for name in sys.argv[1:] or scenarios:
            scenario = scenarios[name]
            if name not in taken_out:
                assert scenario.control is not None
                way, failed = f"control run: {scenario.control.about}", scenario.control.fails[0]
            else:
                way = f"`{taken_out[name][0][0].rpartition('/')[2]}`"
                try:
                    failed = judge(name, taken_out[name], root)
                except ValueError as error:
                    failed = f"ERROR: {error}"
            wrong += not failed or failed.startswith("ERROR")
            print(f"| {name} | {scenario.guards} | {way} | {failed or 'HOLDS'} |", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
