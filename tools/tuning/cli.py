"""``up-sim tune``: proposes gains from simulated flights, or judges the log of any flight."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path

from tools.tuning.evaluation import Rules
from tools.tuning.experiments import Bench
from tools.tuning.gain_set import (
    Axis,
    AxisGains,
    axis_gains,
    gains_of,
    pids_block,
    with_axis,
)
from tools.tuning.log_steps import LogStepsError, steps_of
from tools.tuning.report import log_lines, rough_lines, rules_lines, tuning_lines, yaw_lines
from tools.tuning.response_picture import draw_tuning
from tools.tuning.trial import TrialError
from tools.tuning.tune import TuneError, try_rough_air, tune_axis, tune_yaw
from up.cli.cli_error import CliError, UsageError
from up.commands.gains import Gains, GainSet
from up.config.atomic_writer import write_atomically
from up.flight_controller.pids_file import PIDS, gain_set_of
from up.output import StatusLine
from up_flightlog.plots.canvas import PictureError
from up_flightlog.plots.chart import Mark
from up_flightlog.plots.overview import overview_png
from up_simulator.aircraft import DEFAULT_AIRFRAME, AirframeError, load_airframe
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.board import BoardCrashedError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.preparation import PreparationError, SettingsError
from up_simulator.harness.workers import MAX_PROCESSES, Workers
from up_simulator.picture.flight_picture import overview_of
from up_simulator.scenario.log import LogError, read_log
from up_simulator.scenario.run import try_folder
from up_simulator.verbs.catalogue import HELD, NOT_HELD, verb_parser

FOLDER = Path("run") / "tuning"
EPILOG = """\
examples:
  up-sim tune                               both axes and the yaw damper of the glider
  up-sim tune --airframe wing --axis roll   one axis of another airframe
  up-sim tune --write config/pids.yml       and write the proposed gains
  up-sim tune --log run/flights/x/log.csv   how a flight followed its sticks, and what to change

Exit status: 0 a set was proposed or steps were found, 1 not, 2 wrong input. docs/tuning.md explains
the figures. Gains go to the Raspberry Pi as config/pids.yml, and only then to the
Arduino, while it is disarmed."""
_SENTENCES = (
    BoardCrashedError,
    BoardUnavailableError,
    FlightUnavailableError,
    PreparationError,
    SettingsError,
    TrialError,
    TuneError,
)


_LINE = StatusLine()


def main(arguments: Sequence[str]) -> int:
    """Tune, or analyse a log; return the exit status. Raises ``UsageError`` and OSError."""
    options = _parser().parse_args(arguments)
    if options.log is not None and options.write is not None:
        raise UsageError("--write needs gains that were flown: leave --log out", "usage")
    try:
        return _look_at_log(options) if options.log is not None else _tune(options)
    except (AirframeError, LogError) as error:
        raise UsageError(str(error), "bad_input") from None
    except LogStepsError as error:
        raise UsageError(f"{options.log}: {error}", "bad_input") from None
    except _SENTENCES as error:
        raise CliError(str(error), NOT_HELD, "tuning_failed") from None


def _parser() -> argparse.ArgumentParser:
    parser = verb_parser(
        "tune",
        "Flies steps with many gains, measures the margins of the loop, and proposes a set.",
        EPILOG,
    )
    parser.add_argument(
        "--airframe", default=DEFAULT_AIRFRAME, help="name, folder or file (default: %(default)s)"
    )
    parser.add_argument(
        "--axis", choices=("roll", "pitch", "yaw"), help="only this one (default: all three)"
    )
    parser.add_argument("--quick", action="store_true", help="a coarse look in a third of the time")
    parser.add_argument(
        "--from",
        dest="begin",
        type=Path,
        metavar="PIDS",
        help="begin with the gains of this pids.yml instead of the airframe's",
    )
    parser.add_argument(
        "--log", type=Path, metavar="FLIGHT.csv", help="look at this flight instead"
    )
    parser.add_argument(
        "--write", type=Path, metavar="FILE", help="write the proposed gains (pids.yml)"
    )
    parser.add_argument(
        "--pictures", type=Path, default=FOLDER, metavar="DIR", help="default: %(default)s"
    )
    parser.add_argument(
        "--board",
        choices=("auto", "firmware", "host"),
        default="host",
        help="host: the firmware built for this computer, several times faster; firmware: on the"
        " simulated chip (default: %(default)s)",
    )
    parser.add_argument(
        "--processes",
        type=int,
        choices=range(1, MAX_PROCESSES + 1),
        default=MAX_PROCESSES,
        help="how many flights at a time (default: %(default)s)",
    )
    return parser


def _tune(options: argparse.Namespace) -> int:
    airframe = load_airframe(options.airframe)
    if options.write is not None:
        _check_is_ours(options.write)
        try_folder(options.write.parent)
    gains = gains_of(airframe.gains)
    if options.begin is not None:
        gains = _gains_in(options.begin)
    bench = Bench(airframe, options.board)
    _out(f"{airframe.title}, beginning with roll {axis_gains(gains, 'roll')},")
    _out(f"pitch {axis_gains(gains, 'pitch')}, yaw damper {axis_gains(gains, 'yaw').rate.p:g}")
    with Workers(options.processes, _progress) as workers:
        was = gains
        axes: list[Axis] = [options.axis] if options.axis else ["roll", "pitch", "yaw"]
        gains, pictures, is_good = _all_axes(options, bench, gains, axes, workers)
        air = try_rough_air(bench, was, gains, axes, workers, is_quick=options.quick)
    _LINE.clear()
    _out("")
    for line in rough_lines(air):
        _out(line)
    _out("")
    for line in rules_lines(Rules()):
        _out(line)
    _out("\nProposed, as config/pids.yml has it:\n")
    _out(pids_block(gains))
    if options.write is not None:
        _write(options.write, gains)
        _out(f"written: {options.write}")
    for picture in pictures:
        _out(f"picture: {picture}")
    return HELD if is_good else NOT_HELD


def _all_axes(
    options: argparse.Namespace,
    bench: Bench,
    gains: GainSet,
    axes: Sequence[Axis],
    workers: Workers,
) -> tuple[GainSet, list[Path], bool]:
    pictures: list[Path] = []
    is_good = True
    for axis in axes:
        _out("")
        if axis == "yaw":
            yaw = tune_yaw(bench, gains, workers, is_quick=options.quick)
            damper = 0.0 if yaw is None else yaw.proposal
            gains = with_axis(gains, "yaw", AxisGains(Gains(damper), Gains(0.0)))
            lines = yaw_lines(yaw)
        else:
            tuning = tune_axis(bench, gains, axis, workers, is_quick=options.quick, log=_note)
            gains = with_axis(gains, axis, tuning.proposal.gains)
            is_good = is_good and tuning.keeps_the_rules
            lines = tuning_lines(tuning)
            title = f"Tuning: {bench.airframe.title}"
            path = options.pictures / f"{bench.airframe.name}-{axis}.png"
            if _is_drawn(partial(draw_tuning, tuning, title=title), path):
                pictures.append(path)
        _LINE.clear()
        for line in lines:
            _out(line)
    return gains, pictures, is_good


def _look_at_log(options: argparse.Namespace) -> int:
    log = read_log(options.log)
    axes: tuple[Axis, ...] = (options.axis,) if options.axis else ("roll", "pitch")
    steps = steps_of(log, axes)
    if not steps:
        _out(f"{options.log}: no step in it: a stick that goes somewhere within 0.25 s, in")
        _out("FBW by 5 deg, in RATE by 10 deg/s or more, and stays there for half a second")
        return NOT_HELD
    for line in log_lines(steps):
        _out(line)
    path = options.pictures / f"{options.log.resolve().parent.name}-{options.log.stem}-steps.png"
    marks = [
        Mark(
            step.at_s,
            text=f"{step.axis} {step.mode} {step.start:.0f} to {step.end:.0f} {step.unit}",
        )
        for step in steps
    ]

    def draw(path: Path) -> None:
        overview = overview_of(log, "Steps of a flight", str(options.log), marks)
        path.write_bytes(overview_png(overview))

    if _is_drawn(draw, path):
        _out(f"picture: {path}")
    return HELD


def _gains_in(path: Path) -> GainSet:
    if not path.is_file():
        raise UsageError(f"{path}: no such file", "no_such_file")
    return gain_set_of(PIDS.parse(path.read_bytes(), path))


def _write(path: Path, gains: GainSet) -> None:
    """Write pids.yml whole, with its comments.

    Raises ConfigErrors if the existing file is not a valid pids.yml; it is left alone.
    """
    _check_is_ours(path)
    values = PIDS.parse(pids_block(gains), path)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, PIDS.render(values).encode())


def _check_is_ours(path: Path) -> None:
    """Raise ConfigErrors if a file to be overwritten is not a valid pids.yml."""
    if path.exists():
        PIDS.parse(path.read_bytes(), path)


def _is_drawn(draw: Callable[[Path], None], path: Path) -> bool:
    """Draw into a folder that is made if need be; print why a picture is missing."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        draw(path)
    except PictureError as error:
        _note(str(error))
        return False
    except OSError as error:
        # Remove the incomplete picture.
        with suppress(OSError):
            path.unlink()
        _note(f"{path}: the picture cannot be written: {error.strerror or error}")
        return False
    return True


def _progress(done: int, asked: int) -> None:
    _LINE.show(f"{done} of {asked} flights")


def _note(text: str, /, *, code: str = "", **_fields: object) -> None:
    _LINE.print(text)


def _out(line: str) -> None:
    sys.stdout.write(f"{line}\n")
