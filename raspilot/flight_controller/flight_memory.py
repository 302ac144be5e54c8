"""Home, flight mode and target, which survive a restart of the program in flight."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from twisted.logger import Logger

from up.config import ConfigFile, PersistedFile, key, section


def _degrees(comment: str, limit: float) -> float:
    return key(0.0, comment, unit="deg", minimum=-limit, maximum=limit)


@dataclass(frozen=True, slots=True)
class Place:
    """A position, WGS 84, and its altitude above sea level."""

    latitude_deg: float = _degrees("Latitude.", 90)
    longitude_deg: float = _degrees("Longitude.", 180)
    altitude_m: float = key(0.0, "Altitude.", unit="m", minimum=-1000, maximum=100000)
    radius_m: float | None = key(None, "Of a circle.", unit="m", minimum=0, maximum=100000)


@dataclass(frozen=True, slots=True)
class MemoryConfig:
    """What the flight in progress needs after a restart of the program."""

    mode: str = key("", "The selected flight mode.", max_length=32)
    home: Place | None = section(Place, "Home.", optional=True)
    target: Place | None = section(Place, "Where the mode flies to.", optional=True)


MEMORY = ConfigFile("flight_state.yml", MemoryConfig)


class FlightMemory:
    """Saves changes of MemoryConfig on a thread of its own: an SD card may take a second."""

    log = Logger()

    def __init__(self, folder: Path, reactor: Any) -> None:
        self._file = PersistedFile(folder / MEMORY.filename, MEMORY)
        self._reactor = reactor
        self._lock = threading.Lock()
        self._writer: threading.Thread | None = None
        self.values, problem = self._file.load()
        if problem:
            self.log.warn("{reason}", reason=str(problem), code="flight_state_invalid")

    def clear(self) -> None:
        """Forget an earlier flight; called when the program starts on the ground."""
        self.update(mode="", home=None, target=None)

    def update(self, **changes: Any) -> None:
        """Change values, and save them if they are others."""
        values = replace(self.values, **changes)
        if values != self.values:
            self.values = values
            name = "flight_state.yml writer"
            self._writer = threading.Thread(target=self._save, name=name, daemon=True)
            self._writer.start()

    def wait(self) -> None:
        """Wait until the newest values are on the disk."""
        if self._writer is not None:
            self._writer.join()

    def _save(self) -> None:
        with self._lock:
            try:
                self._file.save(self.values)
            except (OSError, ValueError) as error:
                self._reactor.callFromThread(self._log_unsaved, error)

    def _log_unsaved(self, error: Exception) -> None:
        self.log.error(
            "flight_state.yml was not saved, so a restart in flight would not resume it: {reason}",
            reason=getattr(error, "strerror", None) or str(error),
            code="flight_state_not_saved",
        )
