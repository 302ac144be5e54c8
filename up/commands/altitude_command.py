"""The measured or required altitude of the aircraft, and its airspeed."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class AltitudeCommand(BaseCommand):
    """An altitude above sea level, measured (``actual``) or asked for (``required``)."""

    NAME = "up.altitude.change"
    ROLES = frozenset({Role.SENSOR})
    ROLES_WHERE = {"mode": {"required": frozenset({Role.OPERATOR})}}
    altitude_m: float = value(key="altitude", minimum=-1000, maximum=30000, unit="m")
    mode: str = value("actual", choices=("actual", "required"))


@dataclass(frozen=True, slots=True)
class AirspeedCommand(BaseCommand):
    """A true airspeed, and the differential pressure that it was computed from."""

    NAME = "up.airspeed.update"
    ROLES = frozenset({Role.SENSOR})
    airspeed_m_s: float = value(key="airspeed", minimum=0, maximum=150, unit="m/s")
    pressure_pa: float | None = value(None, key="pressure", unit="Pa")
