"""``up-sim all``: fly every scenario that is shipped, two at a time, and count."""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from up.fields import printable
from up.output import StatusLine
from up.system.death_signal import request_death_signal
from up_simulator.aircraft.model import MODEL_HELP, MODELS
from up_simulator.betaflight.board import find_program
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.harness.two_paths import PathsUnavailableError, check_paths
from up_simulator.scenario.run import FLIGHTS, REPORT, SUMMARY
from up_simulator.scenario.scenario import Scenario
from up_simulator.verbs.catalogue import (
    HELD,
    INTERRUPTED,
    NOT_HELD,
    WRONG_INPUT,
    scenarios_in,
    shipped_paths,
    tagged,
    verb_parser,
)
from up_simulator.verbs.fly import try_output

WAIT_S = 0.05
END_LIMIT_S = 30.0
SHOWN_S = 0.5
_MIB = 1024.0
EPILOG = """\
Fast scenarios fly two at a time, each in its own process; those with real programs follow
one at a time, because they run in real time.

examples:
  up-sim all
  up-sim all --picture --tag faults
  make scenarios"""


@dataclass(slots=True)
class Job:
    """One scenario in a separate process; ``memory_mib`` is its peak memory.

    ``missing`` is a sentence about what it needs and this machine lacks.
    """

    path: Path
    is_real: bool
    folder: Path
    missing: str = ""
    process: subprocess.Popen[bytes] | None = None
    began_s: float = 0.0
    took_s: float = 0.0
    memory_mib: float = 0.0
    status: int | None = None

    @property
    def name(self) -> str:
        return self.path.stem

    def start(self, options: argparse.Namespace) -> None:
        # A summary of an earlier run must not be taken for this one's.
        (self.folder / SUMMARY).unlink(missing_ok=True)
        command = [sys.executable, "-m", "up_simulator.cli", "fly", str(self.path), "--quiet"]
        command += ["--output", str(options.output)]
        command += ["--model", options.model] if options.model else []
        command += [] if options.picture else ["--no-picture"]
        self.began_s = time.monotonic()
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, preexec_fn=request_death_signal()
        )

    def is_over(self) -> bool:
        assert self.process is not None
        found, status, usage = os.wait4(self.process.pid, os.WNOHANG)
        if not found:
            return False
        self.status = self.process.returncode = os.waitstatus_to_exitcode(status)
        self.took_s = time.monotonic() - self.began_s
        self.memory_mib = usage.ru_maxrss / _MIB
        return True

    def summary(self) -> dict[str, object]:
        try:
            found = json.loads((self.folder / SUMMARY).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return found if isinstance(found, dict) else {}


def main(arguments: Sequence[str]) -> int:
    """Fly all; return the exit status."""
    options = _parser().parse_args(arguments)
    jobs = _jobs(options)
    if jobs is None:
        return WRONG_INPUT
    try_output(options.output, [job.name for job in jobs])
    jobs = _without_missing(jobs)
    began_s = time.monotonic()
    batch = Batch(jobs, options, sys.stderr)
    is_interrupted = False
    try:
        batch.fly()
    except KeyboardInterrupt:
        is_interrupted = True
        batch.end()
    _print_table(batch.done, time.monotonic() - began_s, len(jobs))
    if is_interrupted:
        return INTERRUPTED
    return HELD if all(job.status == HELD for job in jobs) else NOT_HELD


def _jobs(options: argparse.Namespace) -> list[Job] | None:
    """Return the flights, the longest first; None if a file has mistakes, which are printed."""
    scenarios, are_right = scenarios_in(shipped_paths())
    if not are_right:
        return None
    jobs: list[tuple[float, Job]] = []
    for path, scenario in tagged(scenarios, options.tag):
        flights = 1 if scenario.control is None else 2
        folder = options.output / path.stem
        job = Job(path, scenario.is_real, folder, _missing(scenario))
        jobs.append((-scenario.duration_s * flights, job))
    jobs.sort(key=lambda each: (each[1].is_real, each[0], each[1].name))
    return [job for _, job in jobs]


def _without_missing(jobs: list[Job]) -> list[Job]:
    """Return the flights that this machine can fly; the others are named and left out."""
    for job in jobs:
        if job.missing:
            sys.stderr.write(f"up-sim: {job.name} is left out: {job.missing}\n")
    return [job for job in jobs if not job.missing]


def _missing(scenario: Scenario) -> str:
    try:
        if scenario.board == "betaflight":
            find_program()
        if scenario.through == "two paths":
            check_paths()
    except (BoardUnavailableError, PathsUnavailableError) as error:
        return str(error)
    return ""


class Batch:
    """Flies jobs, ``options.processes`` at a time; real programs have the machine to themselves."""

    def __init__(self, jobs: list[Job], options: argparse.Namespace, stream: TextIO) -> None:
        self.done: list[Job] = []
        self._waiting = list(jobs)
        self._flying: list[Job] = []
        self._count = len(jobs)
        self._options = options
        self._line = StatusLine(stream, period_s=SHOWN_S)

    def fly(self) -> None:
        while self._waiting or self._flying:
            while self._waiting and self._has_room_for(self._waiting[0]):
                job = self._waiting.pop(0)
                job.start(self._options)
                self._flying.append(job)
            for job in [each for each in self._flying if each.is_over()]:
                self._flying.remove(job)
                self.done.append(job)
            self._show()
            time.sleep(WAIT_S)
        self._line.clear()

    def end(self) -> None:
        """End the running flights; a signal from the terminal has reached them already."""
        # Not by SIGINT: a shell's background job and its children ignore that.
        for job in self._flying:
            if job.process is not None and not job.is_over():
                job.process.send_signal(signal.SIGTERM)
        limit_s = time.monotonic() + END_LIMIT_S
        for job in self._flying:
            while job.status is None and not job.is_over():
                if job.process is not None and time.monotonic() > limit_s:
                    job.process.kill()
                time.sleep(WAIT_S)
        self._line.clear()

    def _has_room_for(self, job: Job) -> bool:
        if job.is_real:
            return not self._flying
        return len(self._flying) < int(self._options.processes)

    def _show(self) -> None:
        names = ", ".join(job.name for job in self._flying)
        self._line.show(f"{len(self.done)} of {self._count}: {names}"[:200])


def _print_table(jobs: list[Job], took_s: float, count: int) -> None:
    width = max((len(job.name) for job in jobs), default=4)
    write = sys.stdout.write
    write(
        f"{'scenario':<{width}}  {'':<8}  {'flown':>8}  {'took':>7}  {'speed':>7}  {'memory':>8}\n"
    )
    for job in sorted(jobs, key=lambda each: each.name):
        summary = job.summary()
        word = "held" if job.status == HELD else "NOT held"
        flown_s, speed = summary.get("flown_s"), summary.get("speed")
        flown = "" if flown_s is None else f"{flown_s:g} s"
        times = "" if speed is None else f"{speed:.1f} x"
        write(
            f"{job.name:<{width}}  {word:<8}  {flown:>8}  {job.took_s:>5.1f} s"
            f"  {times:>7}  {job.memory_mib:>4.0f} MiB\n"
        )
    for job in jobs:
        if job.status != HELD:
            _print_failure(job)
    held = sum(job.status == HELD for job in jobs)
    most = max((job.memory_mib for job in jobs), default=0.0)
    write(f"{took_s:.0f} s, at most {most:.0f} MiB in one process\n")
    write(f"{held} of {count} scenarios held\n")


def _print_failure(job: Job) -> None:
    summary = job.summary()
    expectations = summary.get("expectations", [])
    for verdict in expectations if isinstance(expectations, list) else []:
        if not verdict["held"]:
            limit = f" ({verdict['limit']})" if verdict["limit"] else ""
            why = f": {verdict['why']}" if verdict["why"] else ""
            line = f"  {job.name}: {verdict['name']}: {verdict['figure']}{limit}{why}"
            sys.stdout.write(f"{printable(line)}\n")
    if summary.get("failure"):
        line = f"  {job.name}: {summary['failure']}"
        sys.stdout.write(f"{printable(line)}\n")
    if summary:
        sys.stdout.write(f"  {job.name}: {job.folder / REPORT}\n")


def _parser() -> argparse.ArgumentParser:
    parser = verb_parser(
        "all", "Flies every scenario that is shipped and closes with how many held.", EPILOG
    )
    parser.add_argument("--tag", action="append", default=[], help="only those with this tag")
    parser.add_argument("--model", choices=MODELS, help=MODEL_HELP)
    parser.add_argument("--picture", action="store_true", help="draw pictures, too")
    parser.add_argument(
        "--processes", type=int, choices=range(1, 9), default=2, metavar="N", help="default 2"
    )
    parser.add_argument(
        "--output", type=Path, default=FLIGHTS, metavar="DIR", help=f"default {FLIGHTS}"
    )
    return parser
