"""What a phone on board measures: GPS, barometer, compass and battery, with their noise."""

from __future__ import annotations

import math
import random
from typing import Any

from up_simulator.flight import FlightState

METRES_PER_DEG = 111_320.0
GPS_WANDER_M = 1.5
GPS_JITTER_M = 0.3
GPS_ALTITUDE_M = 3.0
GPS_MEMORY = 0.95
BAROMETER_M = 0.3
COMPASS_DEG = 1.5
BATTERY_FULL = 95.0
BATTERY_PERCENT_PER_S = 0.01


class PhoneSensors:
    """Turns the true state into the data of the Commands that a phone sends.

    GPS errors wander slowly about the truth (some metres) and jitter a little, as real ones do;
    a seed makes them repeatable. The battery falls from ``battery_percent``, which it had at
    ``battery_time_s`` of the flight.
    """

    def __init__(self, seed: int = 1) -> None:
        self._noise = random.Random(seed)
        self._wander_m = [0.0, 0.0, 0.0]
        self.battery_percent = BATTERY_FULL
        self.battery_time_s = 0.0

    def location(self, state: FlightState) -> dict[str, Any]:
        """Return the data of ``up.location.update``."""
        grow = math.sqrt(1 - GPS_MEMORY**2)
        spreads_m = (GPS_WANDER_M, GPS_WANDER_M, GPS_ALTITUDE_M)
        self._wander_m = [
            GPS_MEMORY * wander + grow * self._noise.gauss(0.0, spread)
            for wander, spread in zip(self._wander_m, spreads_m, strict=True)
        ]
        north_m, east_m, up_m = (
            wander + self._noise.gauss(0.0, GPS_JITTER_M) for wander in self._wander_m
        )
        metres_per_deg_east = METRES_PER_DEG * math.cos(math.radians(state.latitude_deg))
        return {
            "latitude": round(state.latitude_deg + north_m / METRES_PER_DEG, 7),
            "longitude": round(state.longitude_deg + east_m / metres_per_deg_east, 7),
            "altitude": round(state.altitude_m + up_m, 1),
            "accuracy": round(2.0 + 2.0 * math.hypot(north_m, east_m) / GPS_WANDER_M, 1),
            "speed": round(max(0.0, state.speed_m_s + self._noise.gauss(0.0, 0.2)), 2),
            "bearing": round((state.track_deg + self._noise.gauss(0.0, 1.0)) % 360.0, 1) % 360.0,
        }

    def altitude(self, state: FlightState) -> dict[str, Any]:
        """Return the data of ``up.altitude.change``, by the barometer."""
        return {"altitude": round(state.altitude_m + self._noise.gauss(0.0, BAROMETER_M), 2)}

    def heading(self, state: FlightState) -> dict[str, Any]:
        """Return the data of ``up.heading.change``, by the compass."""
        heading_deg = (state.yaw_deg + self._noise.gauss(0.0, COMPASS_DEG)) % 360.0
        return {"heading": round(heading_deg, 1) % 360.0, "mode": "actual"}

    def battery(self, state: FlightState) -> dict[str, Any]:
        """Return the data of ``android.battery``: falling with time."""
        used_s = state.time_s - self.battery_time_s
        level = self.battery_percent - BATTERY_PERCENT_PER_S * used_s
        return {"level": max(0, round(level))}
