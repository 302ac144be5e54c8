"""The servos of an aircraft: each follows its pulse with a lag and no faster than it can."""

from __future__ import annotations

import math

from up_simulator.flight import NEUTRAL, Servos

_THROTTLE = 2


class ServoRack:
    """Three servos and a speed controller, which follows at once.

    A servo approaches its pulse as a first-order lag (``lag_s``), at most at ``slew_us_s``: a
    digital 9 g servo takes 0.12 s for 60 degrees, which are about 700 us. ``positions_us`` is where
    ailerons, elevator, throttle and rudder stand.
    """

    def __init__(self, slew_us_s: float, lag_s: float, step_s: float) -> None:
        self._reach_us = slew_us_s * step_s
        self._share = 1.0 - math.exp(-step_s / lag_s) if lag_s > 0 else 1.0
        self._wanted_us: tuple[float, ...] = NEUTRAL
        self.positions_us: list[float] = [float(each) for each in NEUTRAL]

    def set(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Take new pulses; the servos begin to move with the next step."""
        self._wanted_us = pulses_us

    def jump(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Put the servos at these pulses at once."""
        self._wanted_us = pulses_us
        self.positions_us[:] = pulses_us

    def step(self) -> None:
        """Move for one step."""
        positions_us, reach_us = self.positions_us, self._reach_us
        for index, wanted_us in enumerate(self._wanted_us):
            way_us = wanted_us - positions_us[index]
            if not way_us:
                continue
            if index != _THROTTLE:
                way_us *= self._share
                if way_us > reach_us:
                    way_us = reach_us
                elif way_us < -reach_us:
                    way_us = -reach_us
            positions_us[index] += way_us

    @property
    def rounded_us(self) -> Servos:
        """Return where they stand, in whole us."""
        ailerons, elevator, throttle, rudder = (round(each) for each in self.positions_us)
        return ailerons, elevator, throttle, rudder
