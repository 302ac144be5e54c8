"""The attitude that the pilot's sticks require in Fly By Wire (thesis 3.3.2)."""

from __future__ import annotations

from dataclasses import replace

from up.commands.flight_state_command import DEFAULT_LIMITS_DEG, FlyByWireLimitsCommand
from up.quick_dataclass import dataclass

CENTRE_US = 1500
HALF_TRAVEL_US = 500


@dataclass(frozen=True, slots=True)
class Limits:
    """Bank and pitch at full stick, in degrees; by default those of the Arduino."""

    roll_deg: float = DEFAULT_LIMITS_DEG["roll_deg"]
    pitch_up_deg: float = DEFAULT_LIMITS_DEG["pitch_up_deg"]
    pitch_down_deg: float = DEFAULT_LIMITS_DEG["pitch_down_deg"]

    @classmethod
    def of(cls, command: FlyByWireLimitsCommand) -> Limits:
        said = {name: value for name, value in command.data.items() if value is not None}
        return replace(cls(), **said)


DEFAULT_LIMITS = Limits()


def deflection(stick_us: int) -> float:
    """Return a stick's deflection, -1 to 1."""
    return max(-1.0, min(1.0, (stick_us - CENTRE_US) / HALF_TRAVEL_US))


def roll_deg(stick_us: int, limits: Limits = DEFAULT_LIMITS) -> float:
    """Return the bank that the ailerons stick requires, right wing down positive."""
    return deflection(stick_us) * limits.roll_deg


def pitch_deg(stick_us: int, limits: Limits = DEFAULT_LIMITS) -> float:
    """Return the pitch that the elevator stick requires, nose up positive."""
    part = deflection(stick_us)
    return part * (limits.pitch_up_deg if part >= 0 else limits.pitch_down_deg)
