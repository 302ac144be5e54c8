"""The servos of an aircraft: each follows its pulse with a lag and no faster than it can."""

from __future__ import annotations

import math

from up_simulator.aircraft.flight import NEUTRAL, Servos

_THROTTLE = 2


class ServoRack:
    """Three servos and a speed controller, which follows immediately.

    A servo approaches its pulse as a first-order lag (``lag_s``), at most at ``slew_us_s``: a
    digital 9 g servo takes 0.12 s for 60 degrees, which are about 700 us. It rests while its pulse
    is within ``dead_band_us``; its surface follows with a total play of ``play_us``.
    ``positions_us`` has the positions of ailerons, elevator and rudder, and the throttle.
    """

    def __init__(
        self,
        slew_us_s: float,
        lag_s: float,
        step_s: float,
        dead_band_us: float = 0.0,
        play_us: float = 0.0,
    ) -> None:
        self._reach_us = slew_us_s * step_s
        self._share = 1.0 - math.exp(-step_s / lag_s) if lag_s > 0 else 1.0
        self._dead_band_us, self._half_play_us = dead_band_us, play_us / 2
        self._target_us: tuple[float, ...] = NEUTRAL
        self._arms_us: list[float] = [float(each) for each in NEUTRAL]
        self.positions_us: list[float] = [float(each) for each in NEUTRAL]

    def set(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Set new pulses; the servos begin to move in the next step."""
        self._target_us = pulses_us

    def jump(self, pulses_us: tuple[float, float, float, float]) -> None:
        self._target_us = pulses_us
        self._arms_us[:] = pulses_us
        self.positions_us[:] = pulses_us

    def step(self) -> None:
        arms_us, positions_us, reach_us = self._arms_us, self.positions_us, self._reach_us
        half_us = self._half_play_us
        for index, target_us in enumerate(self._target_us):
            travel_us = target_us - arms_us[index]
            if not travel_us:
                continue
            if index != _THROTTLE:
                if -self._dead_band_us < travel_us < self._dead_band_us:
                    continue
                travel_us *= self._share
                if travel_us > reach_us:
                    travel_us = reach_us
                elif travel_us < -reach_us:
                    travel_us = -reach_us
            arms_us[index] += travel_us
            if index == _THROTTLE:
                positions_us[index] = arms_us[index]
            elif positions_us[index] < arms_us[index] - half_us:
                positions_us[index] = arms_us[index] - half_us
            elif positions_us[index] > arms_us[index] + half_us:
                positions_us[index] = arms_us[index] + half_us

    @property
    def rounded_us(self) -> Servos:
        ailerons, elevator, throttle, rudder = (round(each) for each in self.positions_us)
        return ailerons, elevator, throttle, rudder
