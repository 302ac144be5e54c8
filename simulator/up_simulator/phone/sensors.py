"""The measurements of a phone on board, with their noise, and how it is mounted."""

from __future__ import annotations

import math
import random
from collections import deque
from typing import Any, NamedTuple

from up_simulator.aircraft.flight import FlightState

METRES_PER_DEG = 111_320.0
GPS_DELAY_S = (0.3, 1.5)
GPS_WANDER_M = 1.5
GPS_JITTER_M = 0.3
GPS_ALTITUDE_M = 3.0
GPS_CORRELATION = 0.95
BAROMETER_M = 0.3
COMPASS_DEG = 1.5
COMPASS_S = 0.2
"""Correlation time of a compass error, which is the period of the heading."""
INITIAL_BATTERY_PERCENT = 95.0
BATTERY_PERCENT_PER_S = 0.01
SEA_LEVEL_HPA, SEA_LEVEL_K, LAPSE_K_M = 1013.25, 288.15, 0.0065
PRESSURE_POWER = 9.80665 * 0.0289644 / (8.31446 * LAPSE_K_M)
"""Of the standard atmosphere (ISO 2533) up to 11 km."""
_TINY_S = 1e-6
_HALF = math.sqrt(0.5)


class Quaternion(NamedTuple):
    """A rotation w + xi + yj + zk of length one (Hamilton)."""

    w: float
    x: float
    y: float
    z: float

    def times(self, that: Quaternion) -> Quaternion:
        """Return the rotation of ``that`` followed by this."""
        return Quaternion(
            self.w * that.w - self.x * that.x - self.y * that.y - self.z * that.z,
            self.w * that.x + self.x * that.w + self.y * that.z - self.z * that.y,
            self.w * that.y - self.x * that.z + self.y * that.w + self.z * that.x,
            self.w * that.z + self.x * that.y - self.y * that.x + self.z * that.w,
        )

    def conjugate(self) -> Quaternion:
        return Quaternion(self.w, -self.x, -self.y, -self.z)

    def turn(self, x: float, y: float, z: float) -> tuple[float, float, float]:
        turned = self.times(Quaternion(0.0, x, y, z)).times(self.conjugate())
        return turned.x, turned.y, turned.z


def about(axis: int, angle_deg: float) -> Quaternion:
    """Return the right-handed rotation about an axis: 0, 1 or 2 for x, y or z."""
    half_rad = math.radians(angle_deg) / 2
    parts = [math.cos(half_rad), 0.0, 0.0, 0.0]
    parts[1 + axis] = math.sin(half_rad)
    return Quaternion(*parts)


SWAP = Quaternion(0.0, _HALF, _HALF, 0.0)
"""Changes the first two axes for each other and turns the third over: north, east, down to east,
north, up; nose, right wing, down to the axes of a flat phone with its top edge ahead."""

MOUNTING = about(0, -5.0).times(about(2, 12.0)).times(about(1, 80.0)).times(SWAP)
"""Aircraft (nose, right wing, down) to device (right edge, top edge, out of the screen): on its
long edge in a narrow fuselage, and slightly crooked, as in a real installation."""


def body_to_world(roll_deg: float, pitch_deg: float, yaw_deg: float) -> Quaternion:
    """Return the rotation from the aircraft's axes to east, north, up."""
    to_ned = about(2, yaw_deg).times(about(1, pitch_deg)).times(about(0, roll_deg))
    return SWAP.times(to_ned)


class PhoneSensors:
    """Turns the true state into the data of the Commands that a phone sends.

    GPS errors wander slowly about the truth (some metres) and jitter a little, as real ones do;
    a seed makes them repeatable. A fix is at least ``gps_delay_s`` old, 0.3 to 1.5 s drawn by the
    seed; without ``has_gps`` none exists. The battery falls from ``battery_percent``, its
    level at ``battery_time_s`` of the flight. The raw inputs of a phone's software are included:
    pressure, rotation and rate, of a phone mounted as in ``mounting`` (aircraft to device).
    """

    def __init__(self, seed: int = 1, mounting: Quaternion = MOUNTING) -> None:
        self._noise = random.Random(seed)
        self.gps_delay_s = random.Random(f"gps {seed}").uniform(*GPS_DELAY_S)
        self.has_gps = True
        self._past: deque[FlightState] = deque()
        self._mounting = mounting
        self._wander_m = [0.0, 0.0, 0.0]
        self._compass_deg = 0.0
        self._compass_s = -math.inf
        self.battery_percent = INITIAL_BATTERY_PERCENT
        self.battery_time_s = 0.0

    def location(self, state: FlightState) -> dict[str, Any] | None:
        """Return the data of ``up.location.update``; None without a fix."""
        if not self.has_gps:
            return None
        self._remember(state)
        state = self._past[0]
        grow = math.sqrt(1 - GPS_CORRELATION**2)
        spreads_m = (GPS_WANDER_M, GPS_WANDER_M, GPS_ALTITUDE_M)
        self._wander_m = [
            GPS_CORRELATION * wander + grow * self._noise.gauss(0.0, spread)
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
        self._remember(state)
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

    def pressure_hpa(self, state: FlightState) -> float:
        """Return the barometer's reading, by the standard atmosphere."""
        self._remember(state)
        altitude_m = state.altitude_m + self._noise.gauss(0.0, BAROMETER_M)
        part = 1 - LAPSE_K_M * altitude_m / SEA_LEVEL_K
        return round(SEA_LEVEL_HPA * math.pow(part, PRESSURE_POWER), 4)

    def rotation(self, state: FlightState) -> list[float]:
        """Return w, x, y, z of the device's axes in the world (east, north, up).

        North is the compass's: its error lasts for 0.2 s and turns everything.
        """
        if not 0 <= state.time_s - self._compass_s < COMPASS_S - _TINY_S:
            self._compass_s = state.time_s
            self._compass_deg = self._noise.gauss(0.0, COMPASS_DEG)
        yaw_deg = state.yaw_deg + self._compass_deg
        body = body_to_world(state.roll_deg, state.pitch_deg, yaw_deg)
        return [round(each, 9) for each in body.times(self._mounting.conjugate())]

    def _remember(self, state: FlightState) -> None:
        self._past.append(state)
        while len(self._past) > 1 and self._past[1].time_s <= state.time_s - self.gps_delay_s:
            self._past.popleft()

    def rate_rad_s(self, state: FlightState) -> list[float]:
        """Return the gyroscope's reading about the device's axes, rad/s."""
        rates_deg_s = (state.roll_rate_deg_s, state.pitch_rate_deg_s, state.yaw_rate_deg_s)
        turned = self._mounting.turn(*map(math.radians, rates_deg_s))
        return [round(each, 9) for each in turned]
