"""The airspeed by a pitot tube."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class AirspeedCommand(BaseCommand):
    """A true airspeed, and the differential pressure that it was computed from."""

    NAME = "up.airspeed.update"
    ROLES = frozenset({Role.SENSOR})
    airspeed_m_s: float = value(key="airspeed", minimum=0, maximum=150, unit="m/s")
    pressure_pa: float | None = value(None, key="pressure", unit="Pa")
