"""The measurements of a phone on board, with their noise, and how it is mounted."""

from __future__ import annotations

import math
import random
from collections import deque
from typing import Any, Literal

from up_simulator.aircraft.flight import FlightState

METRES_PER_DEG = 111_320.0
GPS_PERIOD_S = 1.0
GPS_DELAY_S, GPS_DELAY_JITTER_S, MIN_GPS_DELAY_S = (0.3, 1.5), 0.1, 0.2
GPS_WANDER_M, GPS_ALTITUDE_WANDER_M, GPS_WANDER_S = (1.5, 3.0), (3.0, 4.0), 20.0
"""A slow error of position and altitude, drawn by the seed, and its correlation time."""
GPS_NOISE_M, GPS_VELOCITY_NOISE_M_S = 1.0, 0.3
GPS_JUMP_M = 300.0
GPS_SATELLITES = 12
MAX_FIX_AGE_S = 2.0
"""An older fix is not sent; the app has the same limit."""
BAROMETER_M = 0.3
COMPASS_DEG = 1.5
INITIAL_BATTERY_PERCENT = 95.0
BATTERY_PERCENT_PER_S = 0.01
_TINY_S = 1e-6


GpsState = Literal["back", "lost", "jumped", "frozen"]


class PhoneSensors:
    """Turns the true state into the data of the Commands that a phone sends.

    A fix is measured once a second and available after a delay with jitter, of a mean drawn by the
    seed. Its error wanders slowly by some metres, as real ones do, plus noise; a seed makes it
    repeatable. ``gps``: ``lost``: no fix; ``jumped``: 300 m beside the truth; ``frozen``: the last
    fix again and again with new times. The battery falls from ``battery_percent``, its
    level at ``battery_time_s`` of the flight.
    ``has_barometer``: whether it measures the altitude by pressure.
    """

    def __init__(self, seed: int = 1) -> None:
        self._noise = random.Random(seed)
        self.gps_delay_s = random.Random(f"gps {seed}").uniform(*GPS_DELAY_S)
        self.gps: GpsState = "back"
        self.has_barometer = True
        self._period_s = GPS_PERIOD_S
        self._fix_noise, self._delay_jitter_s = 1.0, GPS_DELAY_JITTER_S
        self._min_delay_s = MIN_GPS_DELAY_S
        spread = random.Random(f"gps wander {seed}")
        horizontal_m = spread.uniform(*GPS_WANDER_M)
        self._wander_spread_m = (horizontal_m, horizontal_m, spread.uniform(*GPS_ALTITUDE_WANDER_M))
        self._wander_m = [self._noise.gauss(0.0, each) for each in self._wander_spread_m]
        self._knows_altitude = False
        self._fix_s = self._fix_due_s = -math.inf
        self._newest_fix: dict[str, Any] = {}
        self._coming: deque[tuple[float, float, dict[str, Any]]] = deque()
        self.battery_percent = INITIAL_BATTERY_PERCENT
        self.battery_time_s = 0.0

    def use_receiver(
        self, period_s: float, delay_s: float = 0.2, wander_m: float = 0.0, noise: float = 0.0
    ) -> None:
        """Replace the GPS from now on, by default by one without errors.

        A fix is ``delay_s`` old on arrival; the altitude wanders twice as far; ``noise`` is a part
        of a phone's.
        """
        self._period_s = period_s
        self._fix_noise, self._delay_jitter_s = noise, 0.0
        self.gps_delay_s = self._min_delay_s = delay_s
        self._wander_spread_m = (wander_m, wander_m, 2 * wander_m)
        self._wander_m = [0.0, 0.0, 0.0]

    def know_altitude(self) -> None:
        """Begin without an error of the altitude: home's is one of this receiver."""
        self._knows_altitude = True

    @property
    def wander_m(self) -> tuple[float, float, float]:
        """Return the slow error of the fixes now: north, east, up."""
        north_m, east_m, up_m = self._wander_m
        return north_m, east_m, up_m

    def location(self, state: FlightState) -> dict[str, Any] | None:
        """Return the data of ``up.location.update`` of a fix that is newly available, or None."""
        self._receive(state)
        found: tuple[float, dict[str, Any]] | None = None
        while self._coming and self._coming[0][0] <= state.time_s + _TINY_S:
            _, taken_s, data = self._coming.popleft()
            found = taken_s, data
        if found is None or state.time_s - found[0] > MAX_FIX_AGE_S:
            return None
        return {**found[1], "age_ms": round((state.time_s - found[0]) * 1000)}

    def altitude(self, state: FlightState) -> dict[str, Any] | None:
        """Return the data of ``up.altitude.change``, by the barometer; None without one."""
        self._receive(state)
        if not self.has_barometer:
            return None
        return {"altitude": round(state.altitude_m + self._noise.gauss(0.0, BAROMETER_M), 2)}

    def heading(self, state: FlightState) -> dict[str, Any]:
        heading_deg = (state.yaw_deg + self._noise.gauss(0.0, COMPASS_DEG)) % 360.0
        return {"heading": round(heading_deg, 1) % 360.0, "mode": "actual"}

    def battery(self, state: FlightState) -> dict[str, Any]:
        """Return the data of ``android.battery``: falling with time."""
        used_s = state.time_s - self.battery_time_s
        level = self.battery_percent - BATTERY_PERCENT_PER_S * used_s
        return {"level": max(0, round(level))}

    def _receive(self, state: FlightState) -> None:
        """Measure a fix when a second has passed; every measurement of the phone looks here."""
        passed_s = state.time_s - self._fix_s
        if passed_s >= 0.0 and state.time_s < self._fix_due_s - _TINY_S:
            return
        self._fix_s = state.time_s
        # The receiver keeps its seconds when it is asked late.
        late_s = state.time_s - self._fix_due_s
        self._fix_due_s = state.time_s + self._period_s - (late_s if 0 <= late_s < 1 else 0.0)
        keep = math.exp(-min(passed_s, 1000.0) / GPS_WANDER_S) if passed_s > 0.0 else 1.0
        grow = math.sqrt(1.0 - keep * keep)
        self._wander_m = [
            keep * wander + grow * self._noise.gauss(0.0, spread)
            for wander, spread in zip(self._wander_m, self._wander_spread_m, strict=True)
        ]
        if self._knows_altitude and math.isinf(passed_s):
            self._wander_m[2] = 0.0
        delay_s = self.gps_delay_s + self._noise.gauss(0.0, self._delay_jitter_s)
        fix = self._measure(state)
        if self.gps == "lost":
            return
        if self.gps != "frozen" or not self._newest_fix:
            self._newest_fix = fix
        ready_s = state.time_s + max(self._min_delay_s, delay_s)
        self._coming.append((ready_s, state.time_s, self._newest_fix))

    def _measure(self, state: FlightState) -> dict[str, Any]:
        def noise(spread: float) -> float:
            return self._fix_noise * self._noise.gauss(0.0, spread)

        north_m, east_m, up_m = (each + noise(GPS_NOISE_M) for each in self._wander_m)
        if self.gps == "jumped":
            north_m += GPS_JUMP_M
        metres_per_deg_east = METRES_PER_DEG * math.cos(math.radians(state.latitude_deg))
        track = math.radians(state.track_deg)
        north_m_s = state.speed_m_s * math.cos(track) + noise(GPS_VELOCITY_NOISE_M_S)
        east_m_s = state.speed_m_s * math.sin(track) + noise(GPS_VELOCITY_NOISE_M_S)
        bearing_deg = math.degrees(math.atan2(east_m_s, north_m_s)) % 360.0
        return {
            "latitude": round(state.latitude_deg + north_m / METRES_PER_DEG, 7),
            "longitude": round(state.longitude_deg + east_m / metres_per_deg_east, 7),
            "altitude": round(state.altitude_m + up_m, 1),
            "accuracy": round(2.0 + self._wander_spread_m[0], 1),
            "speed": round(math.hypot(north_m_s, east_m_s), 2),
            "bearing": round(bearing_deg, 1) % 360.0,
            "satellites": GPS_SATELLITES,
        }
