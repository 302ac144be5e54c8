"""The required attitude: from the sticks in Fly By Wire, from setpoints, from the failsafe."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up.flight_controller.airframe_profile import DEFAULT_LIMITS_DEG
from up.flight_log.json_message import number_at
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.series import Series

STATE, STICKS, SETPOINT = "up.flight.state", "up.rx.update", "up.setpoint.set"
PROFILE = "arduino.profile.values"
_CENTRE_US, _HALF_TRAVEL_US = 1500.0, 500.0
_CIRCLE = {"circle_bank_deg": 20.0, "glide_pitch_deg": -3.0}
"""The Arduino's default (docs/airframe.md), until the log contains its profile."""


class Demand:
    """The required bank and pitch, in the modes that have a required attitude."""

    def __init__(self, log: FlightLog) -> None:
        self.roll = Series()
        self.pitch = Series()
        self._mode: object = None
        self._is_failsafe = False
        self._limits = dict(DEFAULT_LIMITS_DEG)
        self._circle = dict(_CIRCLE)
        handlers = {
            STATE: self._on_state,
            STICKS: self._on_sticks,
            SETPOINT: self._on_setpoint,
            PROFILE: self._on_profile,
        }
        for message in log.messages(*handlers):
            handlers[message.topic](message.time_s, message.data)

    def _on_state(self, time_s: float, data: Mapping[str, Any]) -> None:
        self._mode = data.get("flight_mode")
        self._is_failsafe = data.get("failsafe") is True

    def _on_profile(self, time_s: float, data: Mapping[str, Any]) -> None:
        for part, known in (("fly_by_wire", self._limits), ("receiver_lost", self._circle)):
            for name in known:
                value = number_at(data, (part, name))
                if value is not None:
                    known[name] = value

    def _on_setpoint(self, time_s: float, data: Mapping[str, Any]) -> None:
        if self._mode == "SETPOINT" and not self._is_failsafe:
            self.roll.add(time_s, number_at(data, ("roll",)))
            self.pitch.add(time_s, number_at(data, ("pitch",)))

    def _on_sticks(self, time_s: float, data: Mapping[str, Any]) -> None:
        if self._is_failsafe:
            self.roll.add(time_s, self._circle["circle_bank_deg"])
            self.pitch.add(time_s, self._circle["glide_pitch_deg"])
        elif self._mode in ("FBW", "OUTPUT"):
            ailerons, elevator = _deflection(data, "ailerons"), _deflection(data, "elevator")
            if ailerons is not None:
                self.roll.add(time_s, ailerons * self._limits["roll_deg"])
            if elevator is not None:
                limit = "pitch_up_deg" if elevator >= 0 else "pitch_down_deg"
                self.pitch.add(time_s, elevator * self._limits[limit])


def _deflection(data: Mapping[str, Any], channel: str) -> float | None:
    pulse_us = number_at(data, (channel,))
    if pulse_us is None:
        return None
    return max(-1.0, min(1.0, (pulse_us - _CENTRE_US) / _HALF_TRAVEL_US))
