"""Turbulence of MIL-F-8785C for low altitudes, by Dryden's spectra."""

from __future__ import annotations

import math
import random

_LOWEST_FT, _HIGHEST_FT = 10.0, 1000.0
_ROOT_3 = math.sqrt(3.0)


class DrydenTurbulence:
    """The velocities of the air along, across and down, and its rates; lengths in feet.

    Scale lengths and deviations are those of MIL-F-8785C 3.7.3 up to 1000 ft; above, those of
    1000 ft. Rates after Yeager, NASA CR-1998-206937. The same seed gives the same turbulence.
    """

    def __init__(self, span_ft: float, step_s: float, seed: int) -> None:
        self._span_ft = span_ft
        self._step_s = step_s
        self._noise = random.Random(seed).gauss
        self._along = self._roll = 0.0
        self._across, self._down = _SecondOrder(), _SecondOrder()
        self._pitch_lag = self._yaw_lag = 0.0

    def step(
        self, airspeed_fps: float, height_ft: float, wind_20ft_fps: float
    ) -> tuple[float, float, float, float, float, float]:
        """Advance by a step; return along, across, down (ft/s), roll, pitch, yaw (rad/s)."""
        speed, span, noise = max(1.0, airspeed_fps), self._span_ft, self._noise
        height = min(_HIGHEST_FT, max(_LOWEST_FT, height_ft))
        shape = 0.177 + 0.000823 * height
        length, length_down = height / shape**1.2, height
        sigma_down = 0.1 * wind_20ft_fps
        sigma = sigma_down / shape**0.4
        passed = self._step_s * speed
        self._along = _first_order(self._along, passed / length, noise(0.0, 1.0))
        across = sigma * self._across.step(passed / length, noise(0.0, 1.0))
        down = sigma_down * self._down.step(passed / length_down, noise(0.0, 1.0))
        middle = math.sqrt(length_down * span)
        self._roll = _first_order(self._roll, passed / (middle / 2.6), noise(0.0, 1.0))
        pitch_length, yaw_length = 4.0 * span / math.pi, 3.0 * span / math.pi
        pitch, yaw = (down - self._pitch_lag) / pitch_length, (across - self._yaw_lag) / yaw_length
        self._pitch_lag += (1.0 - math.exp(-passed / pitch_length)) * (down - self._pitch_lag)
        self._yaw_lag += (1.0 - math.exp(-passed / yaw_length)) * (across - self._yaw_lag)
        return sigma * self._along, across, down, 1.9 / middle * sigma_down * self._roll, pitch, yaw


def _first_order(value: float, passed: float, noise: float) -> float:
    """Return the next value of a first-order process of unit variance."""
    kept = math.exp(-passed)
    return kept * value + math.sqrt(1.0 - kept * kept) * noise


class _SecondOrder:
    """A process of unit variance with Dryden's spectrum of cross velocities."""

    def __init__(self) -> None:
        self._first = self._second = 0.0

    def step(self, passed: float, noise: float) -> float:
        self._second += (1.0 - math.exp(-passed)) * (self._first - self._second)
        self._first = _first_order(self._first, passed, noise)
        return (_ROOT_3 * self._first + (1.0 - _ROOT_3) * self._second) / math.sqrt(2.0)
