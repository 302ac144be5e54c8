"""The summary of one flight for the list of flights, cached so that a list of hundreds is fast."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from up.config.atomic_writer import write_atomically
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.flights import Flight

FORMAT = 1
MAX_ENTRIES = 5000
_ALTITUDES_OTHERWISE = ("up.location.update", "up.telemetry.update")


@dataclasses.dataclass(frozen=True, slots=True)
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


def _highest_m(log: FlightLog) -> float | None:
    heights_m = list(FlightContext(log).altitude.values)
    for topic in _ALTITUDES_OTHERWISE:
        if not heights_m and topic in log.topics:
            heights_m = log.series(topic, "altitude")[1]
    return max(heights_m, default=None)


class OverviewCache:
    """Overviews by flight, valid while its files keep size and modification time.

    Optional: a cache that cannot be read or written is ignored.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._entries = _entries(path)
        self._is_changed = False

    def get(self, flight: Flight) -> Overview | None:
        """Return the cached overview of a flight, or None if its files changed."""
        entry = self._entries.get(_key(flight))
        state = state_of(flight)
        if not isinstance(entry, dict) or state is None or entry.get("state") != state:
            return None
        try:
            return Overview(**entry["overview"])
        except (KeyError, TypeError):
            return None

    def put(self, flight: Flight, overview: Overview) -> None:
        """Keep an overview; one with a fault is read again each time."""
        state = state_of(flight)
        if state is not None and overview.fault is None:
            entry = {"state": state, "overview": dataclasses.asdict(overview)}
            self._entries[_key(flight)] = entry
            self._is_changed = True

    def save(self) -> None:
        if not self._is_changed:
            return
        kept = dict(list(self._entries.items())[-MAX_ENTRIES:])
        with contextlib.suppress(OSError):
            self._path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(self._path, json.dumps({"format": FORMAT, "flights": kept}).encode())


def cache_path(environ: Mapping[str, str]) -> Path:
    """Return the path of the cache (XDG Base Directory Specification)."""
    folder = environ.get("XDG_CACHE_HOME", "")
    base = Path(folder) if folder.startswith("/") else Path.home() / ".cache"
    return base / "raspilot" / "flights.json"


def _entries(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(found, dict) or found.get("format") != FORMAT:
        return {}
    flights = found.get("flights")
    return flights if isinstance(flights, dict) else {}


def _key(flight: Flight) -> str:
    return os.fsencode(flight.paths[0].absolute()).decode("utf-8", "backslashreplace")


def state_of(flight: Flight) -> list[list[int]] | None:
    """Return size and modification time of each file; None if one is missing."""
    try:
        found = [path.stat() for path in flight.paths]
    except OSError:
        return None
    return [[each.st_size, each.st_mtime_ns] for each in found]
