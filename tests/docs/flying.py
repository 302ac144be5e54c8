"""The virtual aircraft, flown from a copy of the tree with files of a page in place."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import until

LIMIT_S = 120.0
# Commands and pages are tried here; tests/test_whole_system.py flies with the chip.
SHOWCASE = [
    sys.executable,
    "-m",
    "up_simulator.demo",
    "--any-ports",
    "--no-watch",
    "--board",
    "host",
]


@dataclass
class Flight:
    """A running ``make run``: its folder, and an environment in which up-ground finds it."""

    tree: Path
    environ: dict[str, str]
    process: subprocess.Popen[bytes]
    said: Path

    def run(self, line: str) -> subprocess.CompletedProcess[str]:
        """Run a line of a page as a person would, in another terminal."""
        return subprocess.run(
            ["bash", "-c", line],
            cwd=self.tree,
            env=self.environ,
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
        )

    def wait_for(self, condition: Callable[[], bool]) -> None:
        """Wait while everything runs; fails with the printed messages."""

        def holds() -> bool:
            assert self.process.poll() is None, self.said.read_text()
            return condition()

        until(holds, self.said.read_text, LIMIT_S)


def files_of(page: str) -> dict[str, str]:
    """Return the files that a page shows, by their path in the application."""
    return dict(re.findall(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", _text(page), re.DOTALL))


def lines_of(page: str, kind: str) -> list[str]:
    """Return the lines of the blocks that a page marks to be run."""
    blocks = re.findall(rf"<!-- run: {kind} -->\n```\n(.*?)```", _text(page), re.DOTALL)
    return [line for block in blocks for line in block.splitlines()]


def copy_of_the_tree(folder: Path) -> Path:
    """A clone of the paths that the pages touch, after ``make run`` has installed everything."""
    for name in ("raspilot", "simulator", "cogs"):
        shutil.copytree(REPOSITORY / name, folder / name)
    shutil.copy(REPOSITORY / "main.py", folder)
    (folder / "config").mkdir()
    return folder


def options_of(line: str) -> list[str]:
    """Return the options that ``make run CONTROLLER=raspberry`` hands to the program."""
    options: list[str] = []
    for word in shlex.split(line.removeprefix("make run")):
        name, _, value = word.partition("=")
        options += shlex.split(value) if name == "ARGS" else [f"--{name.lower()}", value]
    return options


@contextmanager
def flying(folder: Path, files: Mapping[str, str], line: str = "make run") -> Iterator[Flight]:
    """Fly by the command ``line`` until the end of the block; the application has these files."""
    tree = copy_of_the_tree(folder / "tree")
    for name, text in files.items():
        (tree / "raspilot" / name).write_text(text, encoding="utf-8")
    said = folder / "said"
    with said.open("wb") as stream:
        process = subprocess.Popen(
            [*SHOWCASE, *options_of(line)],
            cwd=tree,
            env={**os.environ, "PYTHONPATH": str(tree / "simulator")},
            stdout=stream,
            stderr=subprocess.STDOUT,
        )
    environ = {
        **os.environ,
        "XDG_STATE_HOME": str(folder / "state"),
        "UP_GROUND_STATE": "run/demo/ground",
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
    }
    flight = Flight(tree, environ, process, said)
    try:
        flight.wait_for(lambda: "Ctrl-C stops everything" in said.read_text())
        port = re.search(r"ground on port (\d+)", said.read_text())
        assert port is not None
        environ["UP_GROUND_PORT"] = port[1]
        yield flight
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(LIMIT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _text(page: str) -> str:
    return (REPOSITORY / "docs" / page).read_text(encoding="utf-8")
