"""Where the aircraft is to fly, and where its home is."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

_MAX_HEIGHT_M = 5000


@dataclass(frozen=True, slots=True)
class NavigationTargetCommand(BaseCommand):
    """The point that GUIDED flies to and circles.

    At most one of ``altitude_m`` (above sea level) and ``height_m`` (above home); without either,
    the present altitude. Without ``radius_m``, the radius of LOITER.
    """

    NAME = "up.navigation.target"
    TITLE = "Target"
    ROLES = frozenset({Role.OPERATOR})
    NEEDS_BEACON = True
    latitude_deg: float = value(key="latitude", minimum=-90, maximum=90, unit="deg")
    longitude_deg: float = value(key="longitude", minimum=-180, maximum=180, unit="deg")
    altitude_m: float | None = value(None, key="altitude", minimum=-1000, maximum=9000, unit="m")
    height_m: float | None = value(None, key="height", minimum=0, maximum=_MAX_HEIGHT_M, unit="m")
    radius_m: float | None = value(None, key="radius", minimum=10, maximum=1000, unit="m")

    def __post_init__(self) -> None:
        if self.altitude_m is not None and self.height_m is not None:
            raise ValueError("give altitude or height, not both")


@dataclass(frozen=True, slots=True)
class HomeCommand(BaseCommand):
    """Sets home: to a point, or, without one, to the present position.

    Without ``altitude_m`` (above sea level) home keeps its altitude, or gets the present one.
    """

    NAME = "up.home.set"
    TITLE = "Set home"
    ROLES = frozenset({Role.OPERATOR})
    NEEDS_BEACON = True
    latitude_deg: float | None = value(None, key="latitude", minimum=-90, maximum=90, unit="deg")
    longitude_deg: float | None = value(
        None, key="longitude", minimum=-180, maximum=180, unit="deg"
    )
    altitude_m: float | None = value(None, key="altitude", minimum=-1000, maximum=9000, unit="m")

    def __post_init__(self) -> None:
        if (self.latitude_deg is None) != (self.longitude_deg is None):
            raise ValueError("latitude and longitude belong together")
