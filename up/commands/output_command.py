"""What a flight controller on the Raspberry Pi sends: servo positions or an attitude to hold."""

from up.commands.command import BaseCommand, value
from up.quick_dataclass import dataclass
from up.quick_init import quick_init


@quick_init
@dataclass(frozen=True, slots=True)
class OutputCommand(BaseCommand):
    """Four servo positions in microseconds, and the orientation frame they were computed from.

    Throttle 0 leaves it to the stick. The board refuses an Output whose frame is too old.
    """

    NAME = "up.output.set"
    NEEDS_CONTROL = True
    ailerons_us: int = value(key="ailerons", minimum=1000, maximum=2000, unit="us")
    elevator_us: int = value(key="elevator", minimum=1000, maximum=2000, unit="us")
    throttle_us: int = value(key="throttle", minimum=0, maximum=2000, unit="us")
    rudder_us: int = value(key="rudder", minimum=1000, maximum=2000, unit="us")
    sequence: int = value(minimum=0, maximum=65535)


@quick_init
@dataclass(frozen=True, slots=True)
class SetpointCommand(BaseCommand):
    """An attitude asked of the board; after ``lifetime_ms`` it levels the aircraft.

    One marked as failsafe is followed in the receiver's failsafe only, if the board's profile
    allows it (airframe.yml: receiver_lost: pi_may_fly); after ``lifetime_ms`` the board circles.
    """

    NAME = "up.setpoint.set"
    NEEDS_CONTROL = True
    roll_deg: float = value(key="roll", minimum=-90, maximum=90, unit="deg")
    pitch_deg: float = value(key="pitch", minimum=-90, maximum=90, unit="deg")
    yaw_rate_deg_s: float = value(0.0, key="yaw_rate", minimum=-300, maximum=300, unit="deg/s")
    throttle_us: int | None = value(None, key="throttle", minimum=1000, maximum=2000, unit="us")
    lifetime_ms: int = value(250, minimum=1, maximum=250, unit="ms")
    is_failsafe: bool = value(False, key="failsafe")
