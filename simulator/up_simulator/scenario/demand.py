"""The demands of sticks, failsafe or Raspberry Pi in the active mode."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

CENTRE_US, HALF_TRAVEL_US = 1500.0, 500.0
ROLL_STICK_DEG_S, PITCH_STICK_DEG_S = 180.0, 90.0
"""Rate at full stick in RATE (firmware, flight_controller.h)."""
ROLL_LIMIT_DEG, PITCH_UP_DEG, PITCH_DOWN_DEG = 50.0, 20.0, 25.0
GLIDE_PITCH_DEG, CIRCLE_BANK_DEG = -3.0, 20.0
"""The defaults of an Arduino (docs/airframe.md)."""
_SETPOINT = struct.Struct(">hhhHH")


@dataclass(frozen=True, slots=True)
class Demand:
    """Demanded angles and rates; None without a demand."""

    roll_deg: float | None = None
    pitch_deg: float | None = None
    roll_rate_deg_s: float | None = None
    pitch_rate_deg_s: float | None = None


class DemandModel:
    """The firmware's own mapping, with the limits of the airframe's profile (airframe.yml)."""

    def __init__(self, profile: Mapping[str, Any]) -> None:
        by_wire = profile.get("fly_by_wire") or {}
        lost = profile.get("receiver_lost") or {}
        self._roll_deg = _either(by_wire.get("roll_deg"), ROLL_LIMIT_DEG)
        self._up_deg = _either(by_wire.get("pitch_up_deg"), PITCH_UP_DEG)
        self._down_deg = _either(by_wire.get("pitch_down_deg"), PITCH_DOWN_DEG)
        self._circle = Demand(
            _either(lost.get("circle_bank_deg"), CIRCLE_BANK_DEG),
            _either(lost.get("glide_pitch_deg"), GLIDE_PITCH_DEG),
        )
        self.setpoint: Demand | None = None

    def receive_setpoint(self, payload: bytes) -> None:
        """Take the Setpoint that the Raspberry Pi sent (``S`` or ``R`` of protocols 2.3)."""
        if len(payload) == _SETPOINT.size:
            roll_cdeg, pitch_cdeg, *_ = _SETPOINT.unpack(payload)
            self.setpoint = Demand(roll_cdeg / 100, pitch_cdeg / 100)

    def at(self, mode: str, is_failsafe: bool, sticks_us: Mapping[str, float]) -> Demand:
        """Return the demand in a mode (``OUTPUT``: the Raspberry Pi flies by the sticks)."""
        if is_failsafe and mode != "RETURN":
            return self._circle
        ailerons = _deflection(sticks_us["ailerons"])
        elevator = _deflection(sticks_us["elevator"])
        if mode == "RATE":
            return Demand(
                roll_rate_deg_s=ailerons * ROLL_STICK_DEG_S,
                pitch_rate_deg_s=elevator * PITCH_STICK_DEG_S,
            )
        if mode in ("SETPOINT", "RETURN"):
            return self.setpoint or Demand()
        if mode in ("FBW", "OUTPUT"):
            limit_deg = self._up_deg if elevator >= 0 else self._down_deg
            return Demand(ailerons * self._roll_deg, elevator * limit_deg)
        return Demand()


def _deflection(pulse_us: float) -> float:
    return max(-1.0, min(1.0, (pulse_us - CENTRE_US) / HALF_TRAVEL_US))


def _either(value: Any, default: float) -> float:
    return default if value is None else float(value)
