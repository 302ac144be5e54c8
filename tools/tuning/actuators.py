"""The way from the board's pulses to the servos, where a test can take hold of it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

from tools.tuning.gain_set import Axis
from up_simulator.aircraft import Airframe, FlightDynamics, Start, Weather

Pulses = tuple[float, float, float, float]
NEUTRAL_US = 1500.0
_CHANNELS = ("ailerons", "elevator", "throttle", "rudder")


class Mix:
    """Turns servo pulses into deflections of the axes and back, as the profile's mix does.

    Deflections are us: right wing down, nose up, nose right positive.
    """

    def __init__(self, profile: Mapping[str, Any]) -> None:
        self._mix = profile.get("mix") or "none"
        self._signs = [
            -1.0 if (profile.get(channel) or {}).get("reversed") else 1.0 for channel in _CHANNELS
        ]

    def axes(self, pulses_us: Pulses) -> dict[Axis, float]:
        first, second, _, fourth = (
            sign * (pulse - NEUTRAL_US) for sign, pulse in zip(self._signs, pulses_us, strict=True)
        )
        if self._mix == "elevon":
            return {"roll": (second - first) / 2, "pitch": (first + second) / 2, "yaw": fourth}
        if self._mix == "V-tail":
            return {"roll": first, "pitch": (second + fourth) / 2, "yaw": (second - fourth) / 2}
        return {"roll": first, "pitch": second, "yaw": fourth}

    def pulses(self, axes: Mapping[Axis, float], throttle_us: float) -> Pulses:
        roll, pitch, yaw = axes["roll"], axes["pitch"], axes["yaw"]
        if self._mix == "elevon":
            moves = (pitch - roll, pitch + roll, yaw)
        elif self._mix == "V-tail":
            moves = (roll, pitch + yaw, pitch - yaw)
        else:
            moves = (roll, pitch, yaw)
        ailerons, elevator, rudder = (
            NEUTRAL_US + sign * move
            for sign, move in zip((*self._signs[:2], self._signs[3]), moves, strict=True)
        )
        return ailerons, elevator, throttle_us, rudder


class DisturbedFlight(FlightDynamics):
    """A flight whose servos get the board's pulses later, larger, or with something added.

    ``delay_s`` and ``factors`` (of an axis's deflection) act from now on; ``added_us`` returns the
    pulse to add to an axis at a time. ``on_step`` gets, at each step, the board's pulses and those
    of the servos.
    """

    def __init__(
        self, airframe: Airframe, start: Start, weather: Weather | None, seed: int, mix: Mix
    ) -> None:
        super().__init__(airframe, start, weather, seed, model="jsbsim")
        self.factors: dict[Axis, float] = {}
        self.added_axis: Axis | None = None
        self.added_us: Callable[[float], float] = lambda _time_s: 0.0
        self.on_step: Callable[[dict[Axis, float], dict[Axis, float]], None] | None = None
        self.delay_s = 0.0
        self._mix = mix
        self._waiting: deque[Pulses] = deque()

    def set_servos(self, pulses_us: Pulses) -> None:
        self._waiting.append(pulses_us)
        while len(self._waiting) > round(self.delay_s / self.STEP_S) + 1:
            self._waiting.popleft()
        arriving = self._mix.axes(self._waiting[0])
        for axis, factor in self.factors.items():
            arriving[axis] *= factor
        moved = dict(arriving)
        if self.added_axis is not None:
            moved[self.added_axis] += self.added_us(self.time_s)
        super().set_servos(self._mix.pulses(moved, pulses_us[2]))
        if self.on_step is not None:
            self.on_step(arriving, moved)
