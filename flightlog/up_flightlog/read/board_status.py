"""Decodes a logged ``arduino.status`` into words (docs/protocols.md 2.7).

A log may be read on a machine without the cog that wrote it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up.protocols.board_words import RESET_CAUSES, SWITCH_POSITIONS, VETOES

TOPIC = "arduino.status"
_RESTORED = 7
ARMED, AT_AUTO, RECEIVER_VALID, IMU_VALID, FAILSAFE, BIAS_STORED, GAINS_STORED, PI_HEARD = range(8)
"""Bits of the flags."""
WATCHDOG, BROWN_OUT = 3, 2
"""Bits of the reset cause."""


def has_bit(status: Mapping[str, Any], key: str, bit: int) -> bool | None:
    """Return whether a bit is set; None if the status does not contain it."""
    bits = status.get(key)
    return bool(bits >> bit & 1) if type(bits) is int and 0 <= bits <= 255 else None


def vetoes_of(status: Mapping[str, Any]) -> list[str]:
    """Return the reasons against arming, in words."""
    return [name for bit, name in enumerate(VETOES) if has_bit(status, "vetoes", bit)]


def reset_causes_of(status: Mapping[str, Any]) -> str:
    """Return the cause of the board's last start, in words."""
    named = [name for bit, name in enumerate(RESET_CAUSES) if has_bit(status, "reset_cause", bit)]
    if has_bit(status, "reset_cause", _RESTORED):
        named.append("state restored")
    return ", ".join(named) or "unknown"


def telemetry_of(status: Mapping[str, Any]) -> dict[str, Any]:
    """Return the ``arduino`` part of telemetry (docs/protocols.md 6) that a status determines."""
    switch = status.get("switch")
    return {
        "switch": SWITCH_POSITIONS.get(switch) if isinstance(switch, int) else None,
        "failsafe": has_bit(status, "flags", FAILSAFE),
        "loop_us": status.get("loop_us"),
        "late_us": status.get("late_us"),
        "frame_errors": status.get("frame_errors"),
        "reset_cause": reset_causes_of(status),
        "restored": has_bit(status, "reset_cause", _RESTORED),
        "bias_stored": has_bit(status, "flags", BIAS_STORED),
        "receiver_valid": has_bit(status, "flags", RECEIVER_VALID),
        "imu_valid": has_bit(status, "flags", IMU_VALID),
    }
