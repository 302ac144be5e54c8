"""A pilot who keeps the aircraft in sight: circles around where it was launched."""

from __future__ import annotations

import math
from collections.abc import Callable

from up.earth import GRAVITY_M_S2, bearing_deg, distance_m
from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.sticks import CENTRE_US, HIGHEST_US, LOWEST_US, SWITCH_US, Sticks

HALF_TRAVEL_US = 500
RADIUS_M = 80.0
CRUISE_US = 1530
"""Throttle that about keeps the height."""
MAX_BANK_DEG = 28.0
BANK_PER_COURSE = 0.7
FULL_BANK_DEG, FULL_UP_DEG, FULL_DOWN_DEG = 50.0, 20.0, 25.0
"""Angle at full stick in FBW (the default profile of an Arduino)."""
THROTTLE_US_PER_M, THROTTLE_US_PER_M_S = 25.0, 60.0
MAX_THROTTLE_US = 1900
PITCH_DEG_PER_M, MAX_PITCH_DEG = 0.3, 4.0
RATE_PER_ANGLE = 4.0
"""Rate at which the pilot returns to the attitude where the mode does not, deg/s per deg."""
MAX_ROLL_DEG_S, MAX_PITCH_DEG_S = 60.0, 30.0
FULL_ROLL_DEG_S, FULL_PITCH_DEG_S = 180.0, 90.0
"""Rate at full stick in RATE (firmware, flight_controller.h)."""
SURFACE_US_PER_DEG_S = 3.0
"""Damping by the sticks in ACRO, where they move the surfaces."""


class CirclingPilot:
    """Moves the sticks so that the aircraft stays near and high, for as long as it flies.

    The sticks suit the board's reported mode: ``mode`` returns it, and without a report FBW is
    assumed. The switch stands at ``switch``, AUX2 is up. Without a motor the height of the launch
    is not held.
    """

    def __init__(
        self,
        *,
        switch: str = "AUTO",
        has_motor: bool = True,
        mode: Callable[[], str] = lambda: "",
    ) -> None:
        self._mode = mode
        self._switch_us = SWITCH_US[switch]
        self._has_motor = has_motor
        self._home: FlightState | None = None
        self._newest: FlightState | None = None
        self._climb_m_s = 0.0

    def sticks(self, time_s: float, state: FlightState) -> Sticks:
        if self._home is None:
            self._home = state
        self._watch_climb(state)
        low_m = self._home.height_m - state.height_m
        bank_deg, pitch_deg = self._bank_deg(self._home, state), self._pitch_deg(low_m)
        ailerons_us, elevator_us = _right_stick(self._mode(), bank_deg, pitch_deg, state)
        return Sticks(
            ailerons=ailerons_us,
            elevator=elevator_us,
            throttle=self._throttle_us(low_m),
            aux1=self._switch_us,
            aux2=HIGHEST_US,
        )

    def close(self) -> None:
        """Do nothing: nothing was taken."""

    def _bank_deg(self, home: FlightState, state: FlightState) -> float:
        here = (home.latitude_deg, home.longitude_deg, state.latitude_deg, state.longitude_deg)
        away_m = distance_m(*here)
        inward_deg = math.degrees(math.atan((away_m - RADIUS_M) / RADIUS_M * 2.0))
        course_deg = bearing_deg(*here) + 90.0 + max(-80.0, min(85.0, inward_deg))
        off_deg = (course_deg - state.track_deg + 180.0) % 360.0 - 180.0
        turn_deg = math.degrees(math.atan(state.speed_m_s**2 / (GRAVITY_M_S2 * RADIUS_M)))
        # Far away the way home is straight.
        share = max(0.0, 1.0 - abs(inward_deg) / 80.0)
        bank_deg = turn_deg * share + BANK_PER_COURSE * off_deg
        return max(-MAX_BANK_DEG, min(MAX_BANK_DEG, bank_deg))

    def _pitch_deg(self, low_m: float) -> float:
        if not self._has_motor:
            return 0.0
        return max(-MAX_PITCH_DEG, min(MAX_PITCH_DEG, PITCH_DEG_PER_M * low_m))

    def _throttle_us(self, low_m: float) -> int:
        if not self._has_motor:
            return LOWEST_US
        asked_us = CRUISE_US + THROTTLE_US_PER_M * low_m
        asked_us -= THROTTLE_US_PER_M_S * self._climb_m_s
        return round(max(LOWEST_US, min(MAX_THROTTLE_US, asked_us)))

    def _watch_climb(self, state: FlightState) -> None:
        before, self._newest = self._newest, state
        if before is None or state.time_s <= before.time_s:
            return
        passed_s = state.time_s - before.time_s
        climb_m_s = (state.height_m - before.height_m) / passed_s
        self._climb_m_s += (climb_m_s - self._climb_m_s) * min(1.0, passed_s)


def _right_stick(
    mode: str, bank_deg: float, pitch_deg: float, state: FlightState
) -> tuple[int, int]:
    """Return the pulses of ailerons and elevator that demand an attitude in a mode."""
    if mode not in ("RATE", "ACRO"):
        full_deg = FULL_UP_DEG if pitch_deg > 0 else FULL_DOWN_DEG
        return _stick(bank_deg / FULL_BANK_DEG), _stick(pitch_deg / full_deg)
    roll_deg_s = _within(RATE_PER_ANGLE * (bank_deg - state.roll_deg), MAX_ROLL_DEG_S)
    pitch_deg_s = _within(RATE_PER_ANGLE * (pitch_deg - state.pitch_deg), MAX_PITCH_DEG_S)
    if mode == "RATE":
        return _stick(roll_deg_s / FULL_ROLL_DEG_S), _stick(pitch_deg_s / FULL_PITCH_DEG_S)
    roll_us = SURFACE_US_PER_DEG_S * (roll_deg_s - state.roll_rate_deg_s)
    pitch_us = SURFACE_US_PER_DEG_S * (pitch_deg_s - state.pitch_rate_deg_s)
    return _stick(roll_us / HALF_TRAVEL_US), _stick(pitch_us / HALF_TRAVEL_US)


def _within(value: float, most: float) -> float:
    return max(-most, min(most, value))


def _stick(deflection: float) -> int:
    return round(CENTRE_US + HALF_TRAVEL_US * max(-1.0, min(1.0, deflection)))
