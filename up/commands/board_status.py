"""Reads the board's status from a mapping of its fields (docs/protocols.md 2.7).

The status may come from the board, or from a log, where fields may be absent or invalid.
"""

from collections.abc import Mapping
from typing import Any

from up.commands.board_schema import (
    DATA,
    FLIGHT_MODES,
    REASONS,
    RESET_CAUSES,
    SWITCH_POSITIONS,
    VETOES,
    BoardStatus,
    Reason,
)
from up.commands.schema_rows import Datum
from up.earth import GRAVITY_M_S2

TOPIC = "arduino.status"


def has_bit(status: Mapping[str, Any], key: str, bit: int) -> bool | None:
    """Return whether a bit is set; None if the status does not contain it."""
    bits = status.get(key)
    return bool(bits >> bit & 1) if type(bits) is int and 0 <= bits <= 255 else None


def value_of(status: Mapping[str, Any], datum: Datum) -> Any:
    """Return a field, or a bit of one; None if the status has no number there."""
    if datum.bit is not None:
        return has_bit(status, datum.field, datum.bit)
    number = status.get(datum.field)
    return number if isinstance(number, int | float) else None


def vetoes_of(status: Mapping[str, Any]) -> list[str]:
    """Return the reasons against arming, in words."""
    return [name for bit, name in enumerate(VETOES) if has_bit(status, "vetoes", bit)]


def reset_causes_of(status: Mapping[str, Any]) -> str:
    """Return the cause of the board's last start, in words."""
    named = [name for bit, name in RESET_CAUSES.items() if has_bit(status, "reset_cause", bit)]
    return ", ".join(named) or "unknown"


def forward_m_s2_of(status: BoardStatus) -> float | None:
    """Return the acceleration along the nose, without gravity; None: unknown."""
    if not (status.acceleration and status.is_imu_valid):
        return None
    return (status.acceleration - 128) / 64 * GRAVITY_M_S2


def flight_mode_name(letter: int) -> str | None:
    """Return the name of a flight mode's letter; None for an unknown one."""
    return FLIGHT_MODES.get(chr(letter))


def refusal_name(code: int) -> str:
    """Return a code of `!` as a word: ``throttle_not_low``; empty for an unknown one."""
    return Reason(code).name.lower() if code in REASONS else ""


def refusal_text(code: int) -> str:
    """Return the text of a code of `!`."""
    return REASONS.get(code, f"reason {code}")


def telemetry_of(status: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return the board's part of telemetry that a status determines; None if it has none."""
    shown = (each for each in DATA if each.in_telemetry)
    return {each.name: None if status is None else _telemetry(status, each) for each in shown}


def _telemetry(status: Mapping[str, Any], datum: Datum) -> Any:
    if datum.name == "reset_cause":
        return reset_causes_of(status)
    value = value_of(status, datum)
    return SWITCH_POSITIONS.get(value) if datum.name == "switch" else value
