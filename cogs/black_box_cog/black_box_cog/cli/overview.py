"""What the list of flights tells of one."""

from __future__ import annotations

import fcntl
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from black_box_cog.cli.flights import Flight
from up.flight_log.flight_log import FlightLog
from up.flight_log.mcap_format import FlightLogError

_ALTITUDES = (
    ("up.altitude.change", "altitude"),
    ("up.location.update", "altitude"),
    ("up.telemetry.update", "altitude"),
)


@dataclass(frozen=True, slots=True)
class Overview:
    """A line of the list; ``fault`` is why a flight could not be read, None where it could.

    ``highest_m`` is above sea level, None where nothing told an altitude.
    """

    aircraft: str = ""
    start_unix_s: float = 0.0
    length_s: float = 0.0
    armed_s: float = 0.0
    highest_m: float | None = None
    is_complete: bool = False
    fault: str | None = None


def overview_of(flight: Flight) -> Overview:
    """Read a flight once, and of its messages only those that the list needs."""
    try:
        log = FlightLog.read(flight.paths)
        return Overview(
            aircraft=log.metadata.get("flight", {}).get("aircraft", flight.aircraft),
            start_unix_s=log.start_unix_s,
            length_s=log.length_s,
            armed_s=_armed_s(log),
            highest_m=_highest_m(log),
            is_complete=log.is_complete,
        )
    except FlightLogError as error:
        return Overview(aircraft=flight.aircraft, fault=str(error))


def is_being_recorded(path: Path) -> bool:
    """Return whether the black box still writes into a file: it holds a lock on it."""
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


def _armed_s(log: FlightLog) -> float:
    topic = "up.flight.state" if "up.flight.state" in log.topics else "up.telemetry.update"
    spans = _true_for(
        (message.time_s, message.data.get("armed") is True) for message in log.messages(topic)
    )
    return sum(end_s - begin_s for begin_s, end_s in _closed(spans, log.length_s))


def _true_for(states: Iterable[tuple[float, bool]]) -> Iterable[tuple[float, float | None]]:
    begin_s: float | None = None
    for time_s, is_true in states:
        if is_true and begin_s is None:
            begin_s = time_s
        elif not is_true and begin_s is not None:
            yield begin_s, time_s
            begin_s = None
    if begin_s is not None:
        yield begin_s, None


def _closed(
    spans: Iterable[tuple[float, float | None]], end_s: float
) -> Iterable[tuple[float, float]]:
    return ((begin_s, end_s if last_s is None else last_s) for begin_s, last_s in spans)


def _highest_m(log: FlightLog) -> float | None:
    for topic, field in _ALTITUDES:
        if topic == "up.altitude.change":
            # What is required is not where it was.
            heights = [
                message.data["altitude"]
                for message in log.messages(topic)
                if message.data.get("mode", "actual") == "actual"
                and isinstance(message.data.get("altitude"), int | float)
            ]
        else:
            heights = log.series(topic, field)[1] if topic in log.topics else []
        if heights:
            return float(max(heights))
    return None
