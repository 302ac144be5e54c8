"""The aircraft as phone and radio use it: its state, its time and its servos."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from up_rig.imu import Motion

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


class Dynamics(Protocol):
    """The flight as a board moves and feels it; it advances in steps of its simulated time."""

    motor_works: bool
    """Whether the motor gives thrust; it may change in flight, and nothing reports it."""
    is_thrown: bool
    """Set to True it throws an aircraft that a hand holds."""

    @property
    def state(self) -> FlightState:
        """Return the newest state."""

    @property
    def motion(self) -> Motion:
        """Return the present motion for an IMU aboard."""

    @property
    def a7_v(self) -> float:
        """Return the voltage that the flight battery's divider gives to the board's pin A7."""

    @property
    def crash(self) -> str | None:
        """Return one sentence about the crash; None while it flies. After it the aircraft rests."""

    def set_charge(self, percent: float) -> None:
        """Set the charge of the flight battery."""

    def set_servos(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Command the servos to these pulses."""

    def advance(self, duration_s: float) -> None:
        """Run all whole steps of the time requested so far."""
