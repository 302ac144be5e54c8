"""``up-sim prove``: fly a configuration through every failure, and name what to change."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Sequence
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import TextIO

from up.cli.cli_error import CliError, UsageError
from up.cli.option_parser import add_json_option, whole_number
from up.fields import printable, suggestion
from up.output import StatusLine
from up_simulator.aircraft.model import chosen_model, fall_back_note
from up_simulator.harness.start_options import wind_m_s
from up_simulator.harness.workers import Workers
from up_simulator.prove.advice import advice_of, story
from up_simulator.prove.cases import Case, left_out, quick, thorough
from up_simulator.prove.flight import Outcome, fly_case, refusals
from up_simulator.prove.page import Proof, document, page
from up_simulator.prove.rows import CODES, ROWS, point_of, row_of
from up_simulator.prove.setup import Setup, read_setup
from up_simulator.scenario.run import CannotFlyError
from up_simulator.verbs.catalogue import HELD, INTERRUPTED, NOT_HELD, WRONG_INPUT, verb_parser

OUTPUT = Path("run") / "proof.html"
BAR = 30
EPILOG = """\
examples:
  up-sim prove
      the folder config, the default airframe, calm and 6 m/s of wind: some minutes
  up-sim prove --config run/demo/config --airframe wing --wind 8 --controller raspberry
  up-sim prove --only receiver_lost uplink_lost --seeds 3
  up-sim prove --thorough
      at least 500 flights with drawn wind, turbulence and failures of the GPS, both controllers

Ctrl-C ends it with the results so far. Exit status: 0 all held, 1 something did not, 2 wrong input.

failures:
"""


def main(arguments: Sequence[str]) -> int:
    """Prove a configuration; return the exit status."""
    options = _parser().parse_args(arguments)
    codes = _codes(options.only)
    _try_output(options.output)
    try:
        proof, is_interrupted = _prove(options, codes)
    except CannotFlyError as error:
        status = WRONG_INPUT if error.is_wrong_input else NOT_HELD
        raise CliError(str(error), status, error.code) from error
    options.output.write_text(page(proof), encoding="utf-8")
    if options.json:
        sys.stdout.write(json.dumps(document(proof), indent=1, allow_nan=False) + "\n")
    else:
        _report(proof, options.output)
    if is_interrupted:
        return INTERRUPTED
    return HELD if proof.is_held else NOT_HELD


def _prove(options: argparse.Namespace, codes: Sequence[str]) -> tuple[Proof, bool]:
    setup = read_setup(options.config, options.airframe, options.controller)
    if "AUTO" not in setup.switch.values():
        raise UsageError(
            f"{setup.folder}/airframe.yml: switch: no position selects AUTO: Raspilot never flies",
            "no_auto",
        )
    reasons = left_out(setup, codes)
    flown = [code for code in codes if code not in reasons]
    cases = list(_cases(options, setup, flown))
    if not cases:
        text = f"nothing to fly: {'; '.join(f'{code}: {why}' for code, why in reasons.items())}"
        raise UsageError(text, "nothing_to_fly")
    proof = Proof(setup, len(cases), left_out=reasons)
    for controller in sorted({each.controller for each in cases}):
        proof.refusals += refusals(setup, controller)
    proof.refusals = list(dict.fromkeys(proof.refusals))
    if proof.refusals:
        proof.planned = 0
        return proof, False
    return proof, _fly(proof, cases, options.processes)


def _cases(options: argparse.Namespace, setup: Setup, codes: Sequence[str]) -> list[Case]:
    if not options.thorough:
        return list(quick(setup, codes, options.wind, options.seeds))
    controllers = [options.controller] if options.controller else ["arduino", "raspberry"]
    return list(thorough(setup, codes, controllers, options.seeds))


def _fly(proof: Proof, cases: Sequence[Case], processes: int) -> bool:
    bar = Bar(sys.stderr, len(cases))
    found: dict[int, Outcome] = {}
    is_interrupted = False
    try:
        with Workers(min(processes, len(cases))) as workers:
            for at, outcome in workers.flown(fly_case, [(case, proof.setup) for case in cases]):
                found[at] = outcome
                bar.show(outcome)
    except KeyboardInterrupt:
        is_interrupted = True
    except BrokenProcessPool as error:
        text = "a process that flew was killed; with --processes 1 it needs less memory"
        raise CliError(text, NOT_HELD, "process_ended") from error
    finally:
        bar.end()
    proof.outcomes = [found[at] for at in sorted(found)]
    return is_interrupted


class Bar:
    """The progress: one line on a terminal, otherwise a line for each flight."""

    def __init__(self, stream: TextIO, count: int) -> None:
        self._line, self._count = StatusLine(stream), count
        self._done = self._failed = 0
        self._began_s = time.monotonic()

    def show(self, outcome: Outcome) -> None:
        self._done += 1
        self._failed += not outcome.is_held
        if not self._line.is_terminal:
            case = outcome.case
            codes = ", ".join(outcome.codes) or "held"
            where = f"{row_of(case.row).about}, {point_of(case.point).about}, {case.weather}"
            text = f"{self._done}/{self._count} {where}, {case.controller}: {codes}"
            self._line.print(printable(text))
        else:
            filled = BAR * self._done // self._count
            left_s = (time.monotonic() - self._began_s) * (self._count - self._done) / self._done
            bar = "#" * filled + "." * (BAR - filled)
            text = f"[{bar}] {self._done} of {self._count}, {self._failed} not held"
            self._line.show(f"{text}, {left_s:.0f} s left")

    def end(self) -> None:
        self._line.clear()


def _report(proof: Proof, output: Path) -> None:
    setup = proof.setup

    def write(text: str) -> None:
        sys.stdout.write(f"{printable(text)}\n")

    write(f"{setup.folder}, airframe {setup.airframe}")
    if note := fall_back_note("auto", chosen_model("auto")):
        write(note)
    for text in proof.refusals:
        write(f"  refused: {text}")
    for each in proof.failed:
        write(f"  NOT held: {story(each, setup)}")
        advice = advice_of(each, setup)
        if advice is not None:
            write(f"            change: {advice}")
        write(f"            {each.case.weather}, {each.case.controller}, seed {each.case.seed}")
    for code, count, held, _worst in proof.worst():
        write(
            f"  {'held' if held == count else 'NOT held':<9}{row_of(code).about}: {held} of {count}"
        )
    for code, why in proof.left_out.items():
        write(f"  not flown: {row_of(code).about}: {why}")
    cpu_s = sum(each.cpu_s for each in proof.outcomes)
    write(f"{proof.verdict()} {cpu_s:.0f} s of processor time. {output}")


def _codes(only: Sequence[str]) -> tuple[str, ...]:
    for code in only:
        if code not in CODES:
            hint = suggestion(code, CODES) or f": there are {', '.join(CODES)}"
            raise UsageError(f"--only {code[:60]!r}: unknown failure{hint}", "no_such_failure")
    return tuple(code for code in CODES if not only or code in only)


def _try_output(output: Path) -> None:
    """Raise UsageError if the page cannot be written after all the flights."""
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with output.open("a", encoding="utf-8"):
            pass
    except OSError as error:
        text = f"--output {output}: cannot write there: {error.strerror or error}"
        raise UsageError(text, "cannot_write") from error


def _parser() -> argparse.ArgumentParser:
    parser = verb_parser(
        "prove",
        "Flies your configuration through every failure, at several points of a\n"
        "flight, and names what to change.",
        EPILOG + "\n".join(f"  {row.code:<24}{row.about}" for row in ROWS),
    )
    add = parser.add_argument
    add("--config", type=Path, default=Path("config"), metavar="DIR",
        help="folder with your configuration (default: config)")  # fmt: skip
    add("--airframe", default="glider", metavar="NAME",
        help="a shipped airframe, or the folder of yours (default: glider)")  # fmt: skip
    add("--controller", choices=("arduino", "raspberry"),
        help="who holds the attitude (default: config.yml; --thorough: both)")  # fmt: skip
    add("--wind", type=wind_m_s, default=6.0, metavar="M_S", help="stated wind (default: 6)")
    add("--seeds", type=whole_number(1, 1000), default=1, metavar="N",
        help="flights of each kind, with other noise (default: 1)")  # fmt: skip
    add("--only", nargs="+", default=[], metavar="CODE", help="only these failures")
    add("--thorough", action="store_true", help="at least 500 flights in drawn weather")
    add("--processes", type=whole_number(1, 1000), default=os.cpu_count() or 1, metavar="N",
        help="flights at a time (default: the processor's cores)")  # fmt: skip
    add("--output", type=Path, default=OUTPUT, metavar="FILE.html",
        help=f"the page (default: {OUTPUT})")  # fmt: skip
    add_json_option(parser)
    return parser
