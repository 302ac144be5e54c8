"""The drive: a battery, a brushless motor and a propeller that folds or stops when it is off."""

from __future__ import annotations

import itertools
import math

from up_simulator.aircraft.airframe_file import BatteryConfig, MotorConfig

_AIR_KG_M3 = 1.19
_IDLE = 0.03
_OFF_RPM = 400.0
_RPM = 60 / (2 * math.pi)
# Open-circuit volts of a LiPo cell by its state of charge.
_CELL_V = ((0.0, 3.2), (0.05, 3.5), (0.1, 3.62), (0.3, 3.74), (0.5, 3.82), (0.8, 4.02), (1.0, 4.18))
_CELL_PARTS = tuple(itertools.pairwise(_CELL_V))


class Battery:
    """A LiPo: its voltage sags with the current and falls with the charge used."""

    def __init__(self, config: BatteryConfig) -> None:
        self._config = config
        self._capacity_c = config.capacity_mah * 3.6
        self._left_c = self._capacity_c * config.charge_percent / 100
        self.current_a = 0.0
        self.voltage_v = self.open_v

    @property
    def open_v(self) -> float:
        share = self._left_c / self._capacity_c
        for (low, low_v), (high, high_v) in _CELL_PARTS:
            if share <= high:
                way = (share - low) / (high - low)
                return self._config.cells * (low_v + way * (high_v - low_v))
        return self._config.cells * _CELL_V[-1][1]

    @property
    def is_empty(self) -> bool:
        """Return whether the speed controller has to cut the motor off."""
        return self._left_c <= 0.0

    @property
    def percent(self) -> float:
        return 100 * self._left_c / self._capacity_c

    def charge(self, percent: float | None = None) -> None:
        """Have this charge; by default that of the launch, as another one of the same kind."""
        share = self._config.charge_percent if percent is None else percent
        self._left_c = self._capacity_c * share / 100

    def draw(self, current_a: float, duration_s: float) -> None:
        self.current_a = current_a + self._config.idle_a
        self._left_c = max(0.0, self._left_c - self.current_a * duration_s)
        self.voltage_v = max(0.0, self.open_v - self.current_a * self._config.resistance_ohm)


def charge_at(cell_v: float) -> float:
    """Return the charge of a LiPo, percent, at which a cell has these volts without current."""
    for (low, low_v), (high, high_v) in _CELL_PARTS:
        if cell_v <= high_v:
            return 100 * max(0.0, low + (high - low) * (cell_v - low_v) / (high_v - low_v))
    return 100.0


class Motor:
    """A brushless motor at its speed controller, and its propeller.

    The propeller's coefficients fall in straight lines with the advance ratio J: thrust to zero at
    ``pitch_j``, power to half there. The motor is the usual three-number model (Kv, resistance,
    current without load). Off, a folding propeller is folded; another one brakes the air a little,
    which the airframe's drag holds. ``thrust_n``, ``rpm`` and ``power_w`` (from the battery) are of
    the newest step.
    """

    def __init__(self, motor: MotorConfig, battery: Battery) -> None:
        self._battery = battery
        self._kv_rad = motor.kv_rpm_v / _RPM
        self._resistance = motor.resistance_ohm
        self._free_a = motor.free_current_a
        self._inertia = motor.inertia_kg_m2
        diameter_m = motor.diameter_m
        self._diameter_m = diameter_m
        self._thrust = motor.thrust * _AIR_KG_M3 * diameter_m**4
        self._torque = motor.power * _AIR_KG_M3 * diameter_m**5 / (2 * math.pi)
        self._pitch_j = motor.pitch_j
        self._turns = 0.0
        self.thrust_n = 0.0
        self.power_w = 0.0

    @property
    def rpm(self) -> float:
        return self._turns * 60

    def spin_up(self, throttle: float, airspeed_m_s: float) -> None:
        """Set the steady rotation at this throttle; no charge is drawn."""
        for _ in range(1000):
            self._advance(throttle, airspeed_m_s, 0.002)

    def step(self, throttle: float, airspeed_m_s: float, duration_s: float) -> float:
        """Turn on for a step and return the thrust, N."""
        current_a = self._advance(throttle, airspeed_m_s, duration_s)
        self._battery.draw(current_a, duration_s)
        self.power_w = current_a * self._battery.voltage_v
        return self.thrust_n

    def _advance(self, throttle: float, airspeed_m_s: float, duration_s: float) -> float:
        turns = self._turns
        if turns * 60 < _OFF_RPM and (throttle < _IDLE or self._battery.is_empty):
            self._turns = self.thrust_n = 0.0
            return 0.0
        advance = airspeed_m_s / (turns * self._diameter_m) if turns > 1.0 else 0.0
        share = 1.0 - advance / self._pitch_j
        if share < -0.3:
            share = -0.3
        square = turns * turns
        self.thrust_n = self._thrust * square * share
        torque = self._torque * square * (0.5 + 0.5 * share)
        omega = turns * 2 * math.pi
        back_v = omega / self._kv_rad
        # The speed controller chops the volts; idle, and with an empty battery, it brakes.
        is_driven = throttle >= _IDLE and not self._battery.is_empty
        drive_v = throttle * self._battery.voltage_v if is_driven else 0.0
        motor_a = (drive_v - back_v) / self._resistance
        if motor_a < 0.0:
            motor_a *= 0.3
        push = (motor_a - math.copysign(self._free_a, motor_a)) / self._kv_rad
        omega += (push - torque) / self._inertia * duration_s
        self._turns = omega / (2 * math.pi) if omega > 0.0 else 0.0
        return motor_a * throttle if motor_a > 0.0 else 0.0
