"""Flies a scenario and its control run, and writes the results into a folder."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from up_flightlog.plots.canvas import PictureError
from up_flightlog.plots.overview import overview_png
from up_flightlog.plots.track_picture import Wind
from up_simulator.aircraft import AirframeError
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.board import BoardCrashedError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.preparation import PreparationError, SettingsError
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.signal_handling import interrupts_between_steps
from up_simulator.harness.two_paths import PathsUnavailableError
from up_simulator.picture.flight_picture import overview_of
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.flight_mcap import write_flight
from up_simulator.scenario.flight_record import FlightRecord
from up_simulator.scenario.progress import ProgressLine
from up_simulator.scenario.report import report_lines
from up_simulator.scenario.result import (
    Result,
    control_scenario,
    control_verdicts,
    failed_parts,
    verdicts_of,
)
from up_simulator.scenario.scenario import Scenario

FLIGHTS = Path("run") / "flights"
LOG, CONTROL_LOG, FLIGHT_LOG, REPORT, PICTURE, SUMMARY = (
    "log.csv",
    "control.csv",
    "flight.mcap",
    "report.txt",
    "picture.png",
    "summary.json",
)
BLACK_BOXES = "black-box"
_WRONG_INPUT = (AirframeError, SettingsError)
CAUSES: dict[type[Exception], str] = {
    AirframeError: "airframe",
    SettingsError: "settings",
    BoardCrashedError: "board_crashed",
    BoardUnavailableError: "board_unavailable",
    PathsUnavailableError: PathsUnavailableError.code,
    ParticipantError: "participant_failed",
    FlightUnavailableError: "flight_model_unavailable",
    PreparationError: "eeprom_preparation",
}
Notify = Callable[[str], None]


@dataclass(slots=True)
class Files:
    """The files written of a flight; ``trouble`` is a sentence about the first that failed."""

    written: list[Path] = field(default_factory=list)
    trouble: str | None = None

    def put(self, path: Path, write: Callable[[Path], object]) -> bool:
        """Write a file; delete an incomplete one, which could be taken for a whole one."""
        try:
            write(path)
        except OSError as error:
            with suppress(OSError):
                path.unlink()
            self.trouble = self.trouble or f"{path} is not written: {error.strerror or error}"
            return False
        return True


class CannotFlyError(Exception):
    """A requirement of a scenario is missing here: the message is one sentence for the user.

    ``code`` names the requirement; ``is_wrong_input``: the user has named it.
    """

    def __init__(self, error: Exception) -> None:
        super().__init__(str(error))
        self.is_wrong_input = isinstance(error, _WRONG_INPUT)
        self.code = next(code for kind, code in CAUSES.items() if isinstance(error, kind))


def fly_scenario(
    name: str,
    scenario: Scenario,
    progress: ProgressLine,
    notify: Notify = lambda _text: None,
) -> Result:
    """Fly it and its control run, unless interrupted; evaluate both. Raises CannotFlyError."""
    record = _fly(name, scenario, progress, notify)
    result = Result(record, verdicts_of(record))
    if scenario.control is not None and not record.is_interrupted and record.failure is None:
        # The flight has already reported the cause.
        control = _fly(f"{name}, control run", control_scenario(scenario), progress)
        result.control = control
        result.verdicts += control_verdicts(scenario, control)
    return result


def _fly(
    name: str,
    scenario: Scenario,
    progress: ProgressLine,
    notify: Notify = lambda _text: None,
) -> FlightRecord:
    progress.begin(name, scenario.duration_s)
    try:
        flight = build_flight(scenario, notify)
    except tuple(CAUSES) as error:
        raise CannotFlyError(error) from error
    else:
        with interrupts_between_steps() as interrupt:

            def on_progress(time_s: float) -> None:
                interrupt.check()
                progress.show(time_s)

            return flight.fly(on_progress)
    finally:
        progress.end()


def try_folder(folder: Path) -> None:
    """Make a folder and check that it is writable before the flight; raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryFile(dir=folder) as file:
        file.write(bytes(4096))


def write_files(
    name: str, result: Result, folder: Path, notify: Notify, *, has_picture: bool
) -> Files:
    """Write logs, picture, summary and report, each if it can be."""
    files = Files()
    folder.mkdir(parents=True, exist_ok=True)
    logs = [(LOG, result.record.log)]
    if result.control is not None:
        logs.append((CONTROL_LOG, result.control.log))
    for file_name, log in logs:
        if files.put(folder / file_name, log.write):
            files.written.append(folder / file_name)
    flight_log = folder / FLIGHT_LOG
    if files.put(flight_log, lambda path: write_flight(name, result, path)):
        files.written.append(flight_log)
    _write_black_boxes(result.record.black_boxes, folder / BLACK_BOXES, files)
    if has_picture and len(result.record.log):
        _draw(result, folder / PICTURE, files, notify)
    for path in (folder / CONTROL_LOG, folder / PICTURE):
        if path not in files.written:
            # A file of an earlier flight must not be taken for one of this flight.
            with suppress(OSError):
                path.unlink()
    summary = json.dumps(_summary(name, result), indent=1)
    files.put(folder / SUMMARY, lambda path: path.write_text(summary, encoding="utf-8"))
    report = "\n".join(report_lines(name, result, files.written)) + "\n"
    files.put(folder / REPORT, lambda path: path.write_text(report, encoding="utf-8"))
    return files


def _write_black_boxes(found: Mapping[str, bytes], folder: Path, files: Files) -> None:
    with suppress(OSError):
        for old in folder.glob("*.mcap"):
            old.unlink()
        folder.rmdir()
    for name, data in found.items():
        if files.put(folder / name, partial(_write_below, data)):
            files.written.append(folder / name)


def _write_below(data: bytes, path: Path) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(data)


def _draw(result: Result, path: Path, files: Files, notify: Notify) -> None:
    record = result.record
    weather = record.scenario.weather
    try:
        overview = overview_of(
            record.log,
            title=record.scenario.title,
            subtitle=_subtitle(record),
            failures=list(failed_parts(result)),
            wind=Wind(weather.wind_m_s, weather.wind_from_deg) if weather.wind_m_s else None,
        )
        picture = overview_png(overview)
        if files.put(path, lambda path: path.write_bytes(picture)):
            files.written.append(path)
    except PictureError as error:
        notify(str(error))


def _subtitle(record: FlightRecord) -> str:
    """Return the participants, without values that differ from run to run, such as the speed."""
    scenario = record.scenario
    return f"{scenario.airframe}, seed {scenario.seed}, {record.board_title}"


def _summary(name: str, result: Result) -> dict[str, object]:
    record = result.record
    return {
        "name": name,
        "title": record.scenario.title,
        "model": record.model,
        "held": result.is_held,
        "flown_s": round(record.flown_s, 3),
        "speed": round(record.speed, 2),
        "crash_s": record.crash_s,
        "failure": record.failure,
        "failure_code": record.failure_code,
        "interrupted": result.is_interrupted,
        "notes": record.notes,
        "expectations": [
            {
                "name": verdict.name,
                "held": verdict.is_held,
                "code": verdict.code,
                "figure": verdict.figure,
                "limit": verdict.limit,
                "why": verdict.why,
            }
            for verdict in result.verdicts
        ],
    }
