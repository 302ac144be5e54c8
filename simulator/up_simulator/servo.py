"""A servo: follows its pulse, but not faster than it can."""

from __future__ import annotations

from up_simulator.flight import NEUTRAL, Servos

SLEW_US_PER_S = 6000.0
"""60 degrees (about 700 us) in 0.12 s: an ordinary digital servo."""


class ServoRack:
    """The four servos (the third is a speed controller) with one slew rate, us per second."""

    def __init__(self, slew_us_per_s: float = SLEW_US_PER_S) -> None:
        self._slew_us_per_s = slew_us_per_s
        self._wanted_us: Servos = NEUTRAL
        self._position_us: list[float] = [float(pulse) for pulse in NEUTRAL]

    def set(self, pulses_us: Servos) -> None:
        """Take new pulses; the servos begin to move with the next step."""
        self._wanted_us = pulses_us

    def step(self, duration_s: float) -> None:
        """Move each servo for ``duration_s``."""
        reach_us = self._slew_us_per_s * duration_s
        for index, wanted_us in enumerate(self._wanted_us):
            way_us = wanted_us - self._position_us[index]
            self._position_us[index] += max(-reach_us, min(reach_us, way_us))

    @property
    def exact_us(self) -> tuple[float, float, float, float]:
        """Return where the servos stand, us."""
        ailerons, elevator, throttle, rudder = self._position_us
        return ailerons, elevator, throttle, rudder

    @property
    def rounded_us(self) -> Servos:
        """Return where the servos stand, in whole us."""
        ailerons, elevator, throttle, rudder = (round(each) for each in self._position_us)
        return ailerons, elevator, throttle, rudder
