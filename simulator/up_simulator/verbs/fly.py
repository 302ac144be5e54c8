"""``up-sim fly``: fly scenarios and report the results."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from up.cli.cli_error import CliError, UsageError
from up.fields import printable
from up.output import program_line
from up_simulator.aircraft.model import MODEL_HELP, MODELS
from up_simulator.scenario.file import read_scenario
from up_simulator.scenario.override import Override
from up_simulator.scenario.progress import ProgressLine
from up_simulator.scenario.report import report_lines
from up_simulator.scenario.result import Result
from up_simulator.scenario.run import (
    FLIGHTS,
    CannotFlyError,
    fly_scenario,
    try_folder,
    write_files,
)
from up_simulator.scenario.scenario import BOARDS, Scenario
from up_simulator.verbs.catalogue import (
    HELD,
    INTERRUPTED,
    NOT_HELD,
    WRONG_INPUT,
    find,
    verb_parser,
)

EPILOG = """\
examples:
  up-sim fly level-flight-in-gusts
      a shipped scenario; 'up-sim list' lists them
  up-sim fly my-flight.yml --seed 7 --duration 20
      a file of your own, in other turbulence, for 20 s
  up-sim fly level-flight-in-gusts --set weather.turbulence=severe --set airframe=wing
      any key of the file, by its dotted name
  up-sim fly receiver-lost fbw-roll-step --no-picture --output /tmp/flights

Log, picture and report of each are written into run/flights/NAME/. Ctrl-C ends a flight, which is
reported so far. Exit status: 0 all held, 1 something did not, 2 wrong input."""


def main(arguments: Sequence[str]) -> int:
    """Fly the named scenarios; return the exit status."""
    options = _parser().parse_args(arguments)
    flights = [(path, _read(path, options)) for path in map(find, options.scenarios)]
    try_output(options.output, [path.stem for path, _ in flights])
    results: list[tuple[str, Result]] = []
    is_whole = True
    for path, scenario in flights:
        result, is_written = _fly(path.stem, scenario, options)
        results.append((path.stem, result))
        is_whole = is_whole and is_written
        if result.is_interrupted:
            break
    if len(flights) > 1:
        _print_table(results, len(flights))
    if any(result.record.is_interrupted for _, result in results):
        return INTERRUPTED
    return HELD if is_whole and all(result.is_held for _, result in results) else NOT_HELD


def try_output(output: Path, names: Iterable[str]) -> None:
    """Raise UsageError where the files of a flight of one of these names cannot be written."""
    for name in names:
        try:
            try_folder(output / name)
        except OSError as error:
            why = error.strerror or error
            raise UsageError(
                f"--output {output}: cannot write there: {why}", "cannot_write"
            ) from error


def _read(path: Path, options: argparse.Namespace) -> Scenario:
    overrides = [
        Override(f"{option} {value}", key, value)
        for option, key, value in (
            ("--seed", "seed", options.seed),
            ("--duration", "duration_s", options.duration),
            ("--board", "board", options.board),
            ("--model", "model", options.model),
        )
        if value is not None
    ]
    overrides += [_override(text) for text in options.set]
    return read_scenario(path, overrides)


def _override(text: str) -> Override:
    key, equals, value = text.partition("=")
    if not equals or not key:
        raise UsageError(f"--set {text[:80]}: is not of the form key=value", "bad_override")
    return Override(f"--set {text}", key, value)


def _fly(name: str, scenario: Scenario, options: argparse.Namespace) -> tuple[Result, bool]:
    progress = ProgressLine(sys.stderr, is_shown=not options.quiet)
    try:
        result = fly_scenario(name, scenario, progress, _note)
    except CannotFlyError as error:
        status = WRONG_INPUT if error.is_wrong_input else NOT_HELD
        raise CliError(f"{name}: {error}", status, error.code) from error
    folder = options.output / name
    files = write_files(name, result, folder, _note, has_picture=not options.no_picture)
    if not options.quiet:
        for line in report_lines(name, result, files.written):
            sys.stdout.write(f"{line}\n")
        sys.stdout.flush()
    if files.trouble is not None:
        _note(files.trouble)
    return result, files.trouble is None


def _note(text: str) -> None:
    # The terminal may be closed already.
    with suppress(OSError):
        line = program_line(text, "note", {}, "warning") or f"up-sim: {printable(text)}"
        sys.stderr.write(f"{line}\n")


def _print_table(results: list[tuple[str, Result]], count: int) -> None:
    sys.stdout.write("\n")
    for name, result in results:
        held = sum(verdict.is_held for verdict in result.verdicts)
        word = "held" if result.is_held else "NOT held"
        line = f"{name:<40} {word:<9} {held} of {len(result.verdicts)}"
        sys.stdout.write(f"{printable(line)}\n")
    held = sum(result.is_held for _, result in results)
    sys.stdout.write(f"{held} of {count} scenarios held\n")


def _parser() -> argparse.ArgumentParser:
    parser = verb_parser(
        "fly", "Flies scenarios and reports whether what they expect is true.", EPILOG
    )
    parser.add_argument(
        "scenarios", nargs="+", metavar="SCENARIO", help="a shipped one's name, or a file"
    )
    parser.add_argument("--seed", metavar="N", help="of turbulence and all noise")
    parser.add_argument("--duration", metavar="SECONDS", help="how long to fly")
    parser.add_argument("--board", choices=BOARDS, help="the board (default: the scenario's)")
    parser.add_argument("--model", choices=MODELS, help=MODEL_HELP)
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="another value for a key of the file, as weather.wind_m_s=8",
    )
    parser.add_argument("--no-picture", action="store_true", help="draw no picture")
    parser.add_argument(
        "--output", type=Path, default=FLIGHTS, metavar="DIR", help=f"default {FLIGHTS}"
    )
    parser.add_argument("--quiet", action="store_true", help="no report: the files and the status")
    return parser
