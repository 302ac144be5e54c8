"""What the pilot's sticks ask for in Fly By Wire (thesis 3.3.2)."""

from __future__ import annotations

CENTRE_US = 1500
HALF_TRAVEL_US = 500
ROLL_LIMIT_DEG = 50.0
PITCH_UP_LIMIT_DEG = 20.0
PITCH_DOWN_LIMIT_DEG = 25.0


def deflection(stick_us: int) -> float:
    """Return a stick's deflection, -1 to 1."""
    return max(-1.0, min(1.0, (stick_us - CENTRE_US) / HALF_TRAVEL_US))


def roll_deg(stick_us: int) -> float:
    """Return the bank that the ailerons stick asks for, right wing down positive."""
    return deflection(stick_us) * ROLL_LIMIT_DEG


def pitch_deg(stick_us: int) -> float:
    """Return the pitch that the elevator stick asks for, nose up positive."""
    part = deflection(stick_us)
    return part * (PITCH_UP_LIMIT_DEG if part >= 0 else PITCH_DOWN_LIMIT_DEG)
