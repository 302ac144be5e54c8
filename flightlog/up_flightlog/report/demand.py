"""The required attitude over a log: from the sticks in Fly By Wire, setpoints, the failsafe."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from up.flight_log.json_message import number_at
from up_flightlog.read.demand import Demand, DemandModel
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.series import Series

STATE, STICKS, SETPOINT = "up.flight.state", "up.rx.update", "up.setpoint.set"
PROFILE = "arduino.profile.values"


class DemandSeries:
    """The required bank and pitch, in the modes that have a required attitude."""

    def __init__(self, log: FlightLog) -> None:
        self.roll = Series()
        self.pitch = Series()
        self._mode: object = None
        self._is_failsafe = False
        self._model = DemandModel()
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
        self._model.take_profile(data)

    def _on_setpoint(self, time_s: float, data: Mapping[str, Any]) -> None:
        if self._mode == ("RETURN" if self._is_failsafe else "SETPOINT"):
            self._add(time_s, Demand(number_at(data, ("roll",)), number_at(data, ("pitch",))))

    def _on_sticks(self, time_s: float, data: Mapping[str, Any]) -> None:
        if self._mode != ("RETURN" if self._is_failsafe else "SETPOINT"):
            self._add(time_s, self._model.at(self._mode, self._is_failsafe, data))

    def _add(self, time_s: float, demand: Demand) -> None:
        self.roll.add(time_s, demand.roll_deg)
        self.pitch.add(time_s, demand.pitch_deg)
