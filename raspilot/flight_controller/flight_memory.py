"""Home, flight mode and target, which survive a restart of the program in flight."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from twisted.logger import Logger
from twisted.python.failure import Failure

from raspilot.mission.progress import MissionProgress
from up.config import ConfigFile, PersistedFile, key, section
from up.quick_dataclass import dataclass
from up.system.disk_thread import DiskThread


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
class BarometerOffset:
    """What home's altitude counts by: the barometer's altitude less that of the estimate."""

    source: str = key("", "The barometer.", max_length=64)
    offset_m: float = key(0.0, "Its offset.", unit="m", minimum=-30000, maximum=30000)


@dataclass(frozen=True, slots=True)
class MemoryConfig:
    """What the flight in progress needs after a restart of the program."""

    mode: str = key("", "The selected flight mode.", max_length=32)
    home: Place | None = section(Place, "Home.", optional=True)
    barometer: BarometerOffset | None = section(
        BarometerOffset, "Its offset when home was set.", optional=True
    )
    target: Place | None = section(Place, "Where the mode flies to.", optional=True)
    mission: MissionProgress | None = section(MissionProgress, "MISSION.", optional=True)


MEMORY = ConfigFile("flight_state.yml", MemoryConfig)
MAX_OFFSET_CHANGE_M = 0.5
"""A smaller one of the barometer's offset, by the weather, is not saved."""


class FlightMemory:
    """Saves changes of MemoryConfig beside the reactor."""

    log = Logger()

    def __init__(self, folder: Path, reactor: Any) -> None:
        self._file = PersistedFile(folder / MEMORY.filename, MEMORY)
        self._disk = DiskThread(reactor)
        self.wait = self._disk.wait
        self.values, problem = self._file.load()
        if problem:
            self.log.warn("{reason}", reason=str(problem), code="flight_state_invalid")

    def clear(self) -> None:
        """Forget an earlier flight; called when the program starts on the ground."""
        self.update(mode="", home=None, barometer=None, target=None, mission=None)

    def update(self, **changes: Any) -> None:
        """Change values, and save them if they are others."""
        values = replace(self.values, **changes)
        if values != self.values:
            self.values = values
            self._disk.run(self._save).addErrback(self._log_unsaved)

    def follow_barometer(self, source: str, offset_m: float) -> None:
        """Save another offset, so that heights above home are the same after a restart."""
        saved = self.values.barometer
        if (
            saved is None
            or saved.source != source
            or abs(offset_m - saved.offset_m) > MAX_OFFSET_CHANGE_M
        ):
            self.update(barometer=BarometerOffset(source, offset_m))

    def _save(self) -> None:
        self._file.save(self.values)

    def _log_unsaved(self, failure: Failure) -> None:
        self.log.error(
            "flight_state.yml was not saved, so a restart in flight would not resume it: {reason}",
            reason=getattr(failure.value, "strerror", None) or failure.getErrorMessage(),
            code="flight_state_not_saved",
        )
