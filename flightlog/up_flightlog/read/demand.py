"""The attitude that sticks, failsafe or Raspberry Pi demand in the active mode."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from up.commands.flight_state_command import DEFAULT_LIMITS_DEG
from up.flight_log.json_message import number_at

CENTRE_US, HALF_TRAVEL_US = 1500.0, 500.0
ROLL_STICK_DEG_S, PITCH_STICK_DEG_S = 180.0, 90.0
"""Rate at full stick in RATE (firmware, flight_controller.h)."""
_CIRCLE_DEG = {"circle_bank_deg": 20.0, "glide_pitch_deg": -3.0}
"""The defaults of an Arduino (docs/airframe.md)."""


@dataclass(frozen=True, slots=True)
class Demand:
    """Demanded angles and rates; None without a demand."""

    roll_deg: float | None = None
    pitch_deg: float | None = None
    roll_rate_deg_s: float | None = None
    pitch_rate_deg_s: float | None = None


class DemandModel:
    """The firmware's own mapping, with the limits of the airframe's profile (airframe.yml)."""

    def __init__(self, profile: Mapping[str, Any] | None = None) -> None:
        self._limits_deg = dict(DEFAULT_LIMITS_DEG)
        self._circle_deg = dict(_CIRCLE_DEG)
        self.setpoint = Demand()
        self.take_profile(profile or {})

    def take_profile(self, profile: Mapping[str, Any]) -> None:
        """Use the limits that a profile sets; the others keep their values."""
        for part, known in (("fly_by_wire", self._limits_deg), ("receiver_lost", self._circle_deg)):
            for name in known:
                value = number_at(profile, (part, name))
                if value is not None:
                    known[name] = value

    def at(self, mode: object, is_failsafe: bool, sticks_us: Mapping[str, float]) -> Demand:
        """Return the demand in a mode (``OUTPUT``: the Raspberry Pi flies by the sticks).

        The demand of a stick without a pulse is unknown.
        """
        if is_failsafe and mode != "RETURN":
            return Demand(self._circle_deg["circle_bank_deg"], self._circle_deg["glide_pitch_deg"])
        ailerons, elevator = _deflection(sticks_us, "ailerons"), _deflection(sticks_us, "elevator")
        if mode == "RATE":
            return Demand(
                roll_rate_deg_s=_times(ailerons, ROLL_STICK_DEG_S),
                pitch_rate_deg_s=_times(elevator, PITCH_STICK_DEG_S),
            )
        if mode in ("SETPOINT", "RETURN"):
            return self.setpoint
        if mode in ("FBW", "OUTPUT"):
            limit = "pitch_up_deg" if (elevator or 0.0) >= 0 else "pitch_down_deg"
            return Demand(
                _times(ailerons, self._limits_deg["roll_deg"]),
                _times(elevator, self._limits_deg[limit]),
            )
        return Demand()


def _deflection(sticks_us: Mapping[str, float], channel: str) -> float | None:
    pulse_us = number_at(sticks_us, (channel,))
    if pulse_us is None:
        return None
    return max(-1.0, min(1.0, (pulse_us - CENTRE_US) / HALF_TRAVEL_US))


def _times(deflection: float | None, full: float) -> float | None:
    return None if deflection is None else deflection * full
