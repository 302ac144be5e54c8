"""The summary of one flight for the list of flights."""

from __future__ import annotations

import fcntl
from dataclasses import dataclass
from pathlib import Path

from up.flight_log.flight_context import FlightContext
from up.flight_log.flight_log import FlightLog
from up.flight_log.flights import Flight
from up.flight_log.mcap_format import FlightLogError
from up.flight_log.summary import altitudes_m

_ALTITUDES_OTHERWISE = ("up.location.update", "up.telemetry.update")


@dataclass(frozen=True, slots=True)
class Overview:
    """A line of the list; ``fault`` is the reason if a flight could not be read, otherwise None.

    ``highest_m`` is above sea level, None without a logged altitude.
    """

    aircraft: str = ""
    start_unix_s: float = 0.0
    length_s: float = 0.0
    armed_s: float = 0.0
    highest_m: float | None = None
    is_complete: bool = False
    fault: str | None = None


def overview_of(flight: Flight) -> Overview:
    """Read a flight once, decoding only the messages that the list needs."""
    try:
        log = FlightLog.read(flight.paths)
        return Overview(
            aircraft=log.metadata.get("flight", {}).get("aircraft", flight.aircraft),
            start_unix_s=log.start_unix_s,
            length_s=log.length_s,
            armed_s=sum(span.length_s for span in FlightContext(log).armed),
            highest_m=_highest_m(log),
            is_complete=log.is_complete,
        )
    except FlightLogError as error:
        return Overview(aircraft=flight.aircraft, fault=str(error))


def is_being_recorded(path: Path) -> bool:
    """Return whether the black box still writes the file: it holds a lock on it."""
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


def _highest_m(log: FlightLog) -> float | None:
    heights_m = list(altitudes_m(log))
    for topic in _ALTITUDES_OTHERWISE:
        if not heights_m and topic in log.topics:
            heights_m = log.series(topic, "altitude")[1]
    return max(heights_m, default=None)
