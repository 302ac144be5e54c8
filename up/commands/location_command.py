"""The position of the aircraft."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

FIXES = ("2d", "3d", "dgps", "rtk")
"""Kinds of a fix: without altitude, with it, with corrections, by the phase of the carrier."""


@dataclass(frozen=True, slots=True)
class LocationCommand(BaseCommand):
    """A position from a satellite receiver (thesis 3.3.5), WGS 84.

    ``age_ms`` is the time from the measurement until it was sent, ``satellites`` how many the fix
    uses, ``pdop`` their dilution of precision; speed and bearing are those over the ground. None:
    not known.
    """

    NAME = "up.location.update"
    ALIASES = ("up.location.change",)
    ROLES = frozenset({Role.SENSOR})
    latitude_deg: float = value(key="latitude", minimum=-90, maximum=90, unit="deg")
    longitude_deg: float = value(key="longitude", minimum=-180, maximum=180, unit="deg")
    altitude_m: float | None = value(None, key="altitude", minimum=-1000, maximum=100000, unit="m")
    accuracy_m: float | None = value(None, key="accuracy", minimum=0, unit="m")
    speed_m_s: float | None = value(None, key="speed", minimum=0, unit="m/s")
    bearing_deg: float | None = value(None, key="bearing", minimum=-360, maximum=360, unit="deg")
    distance_from_home_m: float | None = value(None, key="distance_from_home", unit="m")
    required_bearing_deg: float | None = value(None, key="required_bearing", unit="deg")
    age_ms: float | None = value(None, minimum=0, maximum=60000, unit="ms")
    satellites: int | None = value(None, minimum=0, maximum=255)
    fix: str | None = value(None, choices=FIXES)
    pdop: float | None = value(None, minimum=0, maximum=100)
    climb_m_s: float | None = value(None, key="climb", minimum=-200, maximum=200, unit="m/s")
