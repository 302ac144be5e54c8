"""The flight: what the board reports of it, what the ground requests, its limits."""

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class FlightStateCommand(BaseCommand):
    """The flight mode that acts, whether the motor is armed, whether the switch is at AUTO.

    ``is_in_flight`` is None while the board does not say enough to know.
    """

    NAME = "up.flight.state"
    ROLES = frozenset({Role.BOARD})
    flight_mode: str | None = value(max_length=16)
    is_armed: bool = value(key="armed")
    is_auto: bool = value(key="auto")
    is_failsafe: bool = value(key="failsafe")
    is_in_flight: bool | None = value(None, key="in_flight")


@dataclass(frozen=True, slots=True)
class FlightBatteryCommand(BaseCommand):
    """The voltage of the flight battery under its present load, and the load where it is known."""

    NAME = "up.flight_battery.update"
    ROLES = frozenset({Role.BOARD, Role.SENSOR})
    voltage_v: float = value(key="voltage", minimum=0, maximum=66, unit="V")
    current_a: float | None = value(None, key="current", minimum=-1000, maximum=1000, unit="A")


@dataclass(frozen=True, slots=True)
class FlightModeCommand(BaseCommand):
    """A flight mode; taken only while the pilot's switch stands at AUTO, and never ACRO.

    The board's FBW and RATE, AUTO for the Raspberry Pi, or the name of one of its flight modes.
    """

    NAME = "up.flight_mode.set"
    TITLE = "Flight mode {}"
    ROLES = frozenset({Role.OPERATOR})
    mode: str = value(max_length=32)


DEFAULT_LIMITS_DEG = {"roll_deg": 50.0, "pitch_up_deg": 20.0, "pitch_down_deg": 25.0}
"""How far the sticks bank and pitch in FBW by default; the firmware's are in store/profile.cpp."""


@dataclass(frozen=True, slots=True)
class FlyByWireLimitsCommand(BaseCommand):
    """What the airframe's configuration says of the limits; None: it says nothing.

    Published whenever a board answers that may be another one, before it lets anybody fly.
    """

    NAME = "up.flight.limits"
    roll_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
    pitch_up_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
    pitch_down_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
