"""The readings that the Java phone requests, with their times."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from up_simulator.aircraft.flight import Flight, FlightState
from up_simulator.phone.handset import Record
from up_simulator.phone.sensors import PhoneSensors

_TINY_S = 1e-6


@dataclass(slots=True)
class _Stream:
    """One requested sensor."""

    period_s: float
    due_s: float


class SensorFeed:
    """Provides each sensor's readings in the requested period, starting immediately.

    The sensors have the names of the virtual phone's lines. ``now_s`` is of any one clock.
    """

    def __init__(self, flight: Flight, *, seed: int = 1, record: Record | None = None) -> None:
        self._flight = flight
        self.sensors = sensors = PhoneSensors(seed)
        self._measure: dict[str, Callable[[FlightState], Any]] = {
            "fix": sensors.location,
            "pressure": sensors.pressure_hpa,
            "rate": sensors.rate_rad_s,
            "rotation": sensors.rotation,
            "battery": lambda state: sensors.battery(state)["level"],
        }
        if record is not None:
            self._measure["record"] = record
        self._wanted: dict[str, _Stream] = {}

    @property
    def next_s(self) -> float:
        """Return when the next reading is due: infinity without requests."""
        return min((stream.due_s for stream in self._wanted.values()), default=math.inf)

    def want(self, sensor: str, period_s: float, now_s: float) -> None:
        """Provide a sensor's readings with this period from now on; 0: no more."""
        if period_s > 0 and sensor in self._measure:
            self._wanted[sensor] = _Stream(period_s, now_s)
        else:
            self._wanted.pop(sensor, None)

    def set_battery(self, percent: float, now_s: float) -> None:
        """Set the battery level and report it immediately."""
        self.sensors.battery_percent = percent
        self.sensors.battery_time_s = self._flight.state.time_s
        if "battery" in self._wanted:
            self._wanted["battery"].due_s = now_s

    def readings(self, now_s: float) -> dict[str, Any]:
        """Return the due readings by sensor; in the same order every time."""
        found: dict[str, Any] = {}
        for sensor, measure in self._measure.items():
            stream = self._wanted.get(sensor)
            if stream is not None and now_s >= stream.due_s - _TINY_S:
                # A late one does not shift those after it.
                due_s = stream.due_s + stream.period_s
                stream.due_s = due_s if due_s > now_s else now_s + stream.period_s
                reading = measure(self._flight.state)
                if reading is not None:
                    found[sensor] = reading
        return found

    def forget(self) -> None:
        """Cancel all sensors."""
        self._wanted.clear()
