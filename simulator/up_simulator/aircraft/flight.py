"""The aircraft as phone and radio use it: its state, its time and its servos."""

from __future__ import annotations

from dataclasses import dataclass

Servos = tuple[int, int, int, int]
"""Servo pulses, us: ailerons, elevator, throttle, rudder."""

NEUTRAL: Servos = (1500, 1500, 1000, 1500)


class FlightUnavailableError(Exception):
    """No flight is possible: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class FlightState:
    """The true state of the aircraft at one moment.

    Positive roll is right wing down, positive pitch nose up, positive yaw clockwise from above.
    Rates are those of the body axes, as measured by a gyroscope. Altitude is above the sea,
    height above the ground; speed is over the ground, along ``track_deg``. The angles of the air
    are of attack (alpha) and of sideslip (wind from the right positive); the load factor is 1 in
    level flight; ``north_m`` and ``east_m`` count from the start of the flight. The wind is the
    velocity of the air around it, gusts and turbulence included.
    """

    time_s: float
    roll_deg: float
    pitch_deg: float
    yaw_deg: float
    roll_rate_deg_s: float
    pitch_rate_deg_s: float
    yaw_rate_deg_s: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    height_m: float
    speed_m_s: float
    track_deg: float
    airspeed_m_s: float
    alpha_deg: float = 0.0
    sideslip_deg: float = 0.0
    load_factor_g: float = 1.0
    climb_m_s: float = 0.0
    north_m: float = 0.0
    east_m: float = 0.0
    battery_v: float = 0.0
    battery_percent: float = 100.0
    motor_rpm: float = 0.0
    motor_w: float = 0.0
    wind_north_m_s: float = 0.0
    wind_east_m_s: float = 0.0
    wind_down_m_s: float = 0.0
