"""The attitude of the aircraft, and its acceleration."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass
from up.quick_init import quick_init


@quick_init
@dataclass(frozen=True, slots=True)
class OrientationCommand(BaseCommand):
    """An attitude and, where the source knows them, the rotation rates.

    ``sequence`` is the board's number of the frame, which an Output computed from it echoes.
    """

    NAME = "up.orientation.update"
    ROLES = frozenset({Role.SENSOR, Role.BOARD})
    roll_deg: float = value(key="roll", minimum=-360, maximum=360, unit="deg")
    pitch_deg: float = value(key="pitch", minimum=-360, maximum=360, unit="deg")
    yaw_deg: float = value(key="yaw", minimum=-360, maximum=360, unit="deg")
    roll_rate_deg_s: float | None = value(
        None, key="roll_rate", minimum=-4000, maximum=4000, unit="deg/s"
    )
    pitch_rate_deg_s: float | None = value(
        None, key="pitch_rate", minimum=-4000, maximum=4000, unit="deg/s"
    )
    yaw_rate_deg_s: float | None = value(
        None, key="yaw_rate", minimum=-4000, maximum=4000, unit="deg/s"
    )
    sequence: int | None = value(None, minimum=0, maximum=65535)


@dataclass(frozen=True, slots=True)
class AccelerationCommand(BaseCommand):
    """Change of the speed along the nose: the specific force without gravity, level."""

    NAME = "up.acceleration.update"
    ROLES = frozenset({Role.BOARD})
    forward_m_s2: float = value(key="forward", minimum=-100, maximum=100, unit="m/s2")
