"""The aircraft where no air carries it: in the hand that throws it, and on the ground."""

from __future__ import annotations

import math
from dataclasses import replace

from up.flight_modes.navigation_state import LocalFrame, Point
from up_rig.imu import Motion, motion_at
from up_simulator.aircraft.flight import FlightState

ARM_M = 1.5
"""Way along which a throw accelerates the aircraft evenly."""
FRICTION_M_S2 = 4.0
"""Of a belly on grass."""
MAX_SINK_M_S, MAX_BANK_DEG, MAX_PITCH_DEG = 3.0, 20.0, 20.0
"""A contact with the ground beyond one of these is a crash, not a landing."""


def is_soft(state: FlightState) -> bool:
    """Return whether a contact with the ground is a landing."""
    return (
        -state.climb_m_s <= MAX_SINK_M_S
        and abs(state.roll_deg) <= MAX_BANK_DEG
        and abs(state.pitch_deg) <= MAX_PITCH_DEG
    )


class GroundRun:
    """Moves evenly accelerated along its track, at a constant attitude, for ``duration_s``.

    ``state`` is that at the end of a throw, or at the touchdown.
    """

    def __init__(
        self, state: FlightState, begin_m_s: float, acceleration_m_s2: float, ahead_m: float
    ) -> None:
        self._state = state
        self._begin_m_s = begin_m_s
        self._acceleration_m_s2 = acceleration_m_s2
        self._ahead_m = ahead_m
        self._passed_s = 0.0
        end_m_s = 0.0 if begin_m_s else math.sqrt(2.0 * acceleration_m_s2 * -ahead_m)
        self._duration_s = (end_m_s - begin_m_s) / acceleration_m_s2

    @classmethod
    def in_the_hand(cls, released: FlightState, speed_m_s: float) -> GroundRun:
        """Return the aircraft held behind the place where a throw releases it at this speed."""
        return cls(released, 0.0, speed_m_s * speed_m_s / (2.0 * ARM_M), -ARM_M)

    @classmethod
    def on_the_ground(cls, touched: FlightState) -> GroundRun:
        """Return the aircraft that slides on from its touchdown, and stops."""
        return cls(touched, max(0.01, touched.speed_m_s), -FRICTION_M_S2, 0.0)

    @property
    def is_over(self) -> bool:
        return self._passed_s >= self._duration_s

    def advance(self, duration_s: float) -> None:
        self._passed_s = min(self._duration_s, self._passed_s + duration_s)

    @property
    def motion(self) -> Motion:
        still = motion_at(self._state.roll_deg, self._state.pitch_deg)
        push_m_s2 = self._acceleration_m_s2 if 0.0 < self._passed_s < self._duration_s else 0.0
        return replace(still, force_x_m_s2=still.force_x_m_s2 + push_m_s2)

    @property
    def state(self) -> FlightState:
        state, passed_s = self._state, self._passed_s
        speed_m_s = max(0.0, self._begin_m_s + self._acceleration_m_s2 * passed_s)
        ahead_m = self._ahead_m + 0.5 * (self._begin_m_s + speed_m_s) * passed_s
        track = math.radians(state.track_deg)
        cosine, sine = math.cos(track), math.sin(track)
        north_m, east_m = ahead_m * cosine, ahead_m * sine
        through_air_m_s = math.hypot(
            speed_m_s * cosine - state.wind_north_m_s, speed_m_s * sine - state.wind_east_m_s
        )
        frame = LocalFrame(state.latitude_deg, state.longitude_deg)
        latitude_deg, longitude_deg = frame.degrees(Point(north_m, east_m))
        return replace(
            state,
            north_m=state.north_m + north_m,
            east_m=state.east_m + east_m,
            latitude_deg=latitude_deg,
            longitude_deg=longitude_deg,
            speed_m_s=speed_m_s,
            airspeed_m_s=through_air_m_s,
            climb_m_s=0.0,
            roll_rate_deg_s=0.0,
            pitch_rate_deg_s=0.0,
            yaw_rate_deg_s=0.0,
            load_factor_g=1.0,
        )
