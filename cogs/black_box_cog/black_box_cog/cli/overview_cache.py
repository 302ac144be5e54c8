"""A cache of flight summaries, so that a list of hundreds appears immediately."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from black_box_cog.cli.overview import Overview
from up.config.atomic_writer import write_atomically
from up.flight_log.flights import Flight

FORMAT = 1
MAX_ENTRIES = 5000


class OverviewCache:
    """Overviews by flight, valid while its files keep size and modification time.

    Optional: a cache that cannot be read or written is ignored.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._entries = _entries(path)
        self._has_news = False

    def get(self, flight: Flight) -> Overview | None:
        """Return the cached overview of a flight, or None if its files changed."""
        entry = self._entries.get(_key(flight))
        state = _state(flight)
        if not isinstance(entry, dict) or state is None or entry.get("state") != state:
            return None
        try:
            return Overview(**entry["overview"])
        except (KeyError, TypeError):
            return None

    def put(self, flight: Flight, overview: Overview) -> None:
        """Keep an overview; one with a fault is read again each time."""
        state = _state(flight)
        if state is not None and overview.fault is None:
            entry = {"state": state, "overview": dataclasses.asdict(overview)}
            self._entries[_key(flight)] = entry
            self._has_news = True

    def save(self) -> None:
        """Write the new entries; the oldest are removed."""
        if not self._has_news:
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


def _state(flight: Flight) -> list[list[int]] | None:
    try:
        found = [path.stat() for path in flight.paths]
    except OSError:
        return None
    return [[each.st_size, each.st_mtime_ns] for each in found]
