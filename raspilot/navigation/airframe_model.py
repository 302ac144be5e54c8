"""What the airframe needs for an airspeed: sink, angle of attack, throttle, load."""

import math

from up.earth import GRAVITY_M_S2
from up.flight_modes.navigation_file import NavigationConfig

STALL_MARGIN = 1.15
"""The turn's stall speed times this stays below the airspeed."""
STOP_SEEN_S = 2.0
"""From a silent stop of the motor until the nose is down."""
LEAST_CLIMB_M_S = 1.0
"""Climb through the air that is permitted with less reserve: to hold the altitude in gusts."""


class AirframeModel:
    """The polar and the throttle of ``navigation.yml``, for the control and for the estimator.

    The load factor ``load`` is the lift over the weight: 1 level, more in a turn.
    """

    def __init__(self, config: NavigationConfig | None = None) -> None:
        config = config or NavigationConfig()
        self.speeds = config.airspeed
        self.has_motor = config.performance.motor
        self.level_throttle = config.performance.level_throttle
        self._best_glide_m_s = self.speeds.best_glide_m_s
        self._half_sink_m_s = 0.5 * (self._best_glide_m_s / config.performance.glide_ratio)
        self._cruise_sink_m_s = self.sink_m_s(self.speeds.cruise_m_s, 1.0)
        level = config.performance.level_throttle
        full_m_s = self._cruise_sink_m_s + config.performance.full_throttle_climb_m_s
        # Quadratic, through the level flight and the climb at full throttle.
        self._power_2 = max(0.0, (self._cruise_sink_m_s / level - full_m_s) / (level - 1.0))
        self._power_1 = full_m_s - self._power_2
        self._stall_squared = self.speeds.stall_m_s * self.speeds.stall_m_s
        performance, cruise_lift = config.performance, self._lift(self.speeds.cruise_m_s, 1.0)
        span_deg = performance.stall_pitch_deg - performance.cruise_pitch_deg
        self._lift_deg = span_deg / (1.0 - cruise_lift)
        self._zero_lift_deg = performance.stall_pitch_deg - self._lift_deg

    def sink_m_s(self, airspeed_m_s: float, load: float) -> float:
        """Return the sink without motor: a parabolic polar."""
        part = airspeed_m_s / self._best_glide_m_s
        return self._half_sink_m_s * (part * part * part + load * load / part)

    def level_pitch_deg(self, airspeed_m_s: float, load: float) -> float:
        """Return the pitch that holds the altitude: the part of the angle of attack upwards."""
        lift = load * self._stall_squared / (airspeed_m_s * airspeed_m_s)
        return (self._zero_lift_deg + self._lift_deg * (lift if lift < 1.0 else 1.0)) / load

    def glide_pitch_deg(self, airspeed_m_s: float, load: float) -> float:
        slope = self.sink_m_s(airspeed_m_s, load) / airspeed_m_s
        return self.level_pitch_deg(airspeed_m_s, load) - math.degrees(math.atan(slope))

    def throttle(self, power_m_s: float) -> float:
        """Return the throttle for a power over the weight: the climb that no drag would allow."""
        squared, linear = self._power_2, self._power_1
        if squared <= 0.0:
            return max(0.0, min(1.0, power_m_s / linear))
        if power_m_s <= 0.0:
            # Where a windmilling propeller begins to pull; below, the throttle closes gradually.
            idle = max(0.0, -linear / squared)
            return max(0.0, idle * (1.0 + power_m_s / self._cruise_sink_m_s))
        root = math.sqrt(linear * linear + 4.0 * squared * power_m_s)
        return min(1.0, (root - linear) / (2.0 * squared))

    def power_m_s(self, throttle: float) -> float:
        """Return the power over the weight of a throttle, the inverse of ``throttle``."""
        if not self.has_motor:
            return 0.0
        power_m_s = throttle * (self._power_2 * throttle + self._power_1)
        return power_m_s if power_m_s > 0.0 else 0.0

    def least_climb_pitch_deg(self, airspeed_m_s: float, load: float) -> float:
        slope_deg = math.degrees(LEAST_CLIMB_M_S / airspeed_m_s)
        return self.level_pitch_deg(airspeed_m_s, load) + slope_deg

    def climb_pitch_deg(self, airspeed_m_s: float, load: float) -> float:
        """Return the greatest pitch in which the motor may stop unseen for ``STOP_SEEN_S``.

        While this pitch stays, the airspeed falls to ``STALL_MARGIN`` times the stall speed: the
        loss is that of the climb and of the drag at the mean airspeed.
        """
        least_m_s = STALL_MARGIN * self.speeds.stall_m_s * math.sqrt(load)
        mean_m_s = 0.5 * (airspeed_m_s + least_m_s)
        loss_m_s2 = (airspeed_m_s - least_m_s) / STOP_SEEN_S
        slope = loss_m_s2 / GRAVITY_M_S2 - self.sink_m_s(mean_m_s, load) / mean_m_s
        kept_deg = self.level_pitch_deg(mean_m_s, load) + math.degrees(slope)
        return max(kept_deg, self.least_climb_pitch_deg(airspeed_m_s, load))

    def climb_airspeed_m_s(self, climb_m_s: float) -> float:
        """Return the least airspeed, cruise or above, whose ``climb_pitch_deg`` gives a climb."""
        airspeed = self.speeds.cruise_m_s
        while airspeed < self.speeds.maximum_m_s:
            slope_deg = self.climb_pitch_deg(airspeed, 1.0) - self.level_pitch_deg(airspeed, 1.0)
            if airspeed * math.radians(slope_deg) >= climb_m_s:
                return airspeed
            airspeed += 0.25
        return self.speeds.maximum_m_s

    def bank_limit_deg(self, airspeed_m_s: float) -> float:
        """Return the bank whose stall is still ``STALL_MARGIN`` below the airspeed."""
        cosine = STALL_MARGIN * STALL_MARGIN * self._lift(airspeed_m_s, 1.0)
        return math.degrees(math.acos(cosine)) if cosine < 1.0 else 0.0

    def _lift(self, airspeed_m_s: float, load: float) -> float:
        return load * self._stall_squared / (airspeed_m_s * airspeed_m_s)


def load_of(roll_deg: float) -> float:
    """Return the load factor of a level turn, at most 2."""
    cosine = math.cos(math.radians(roll_deg))
    return 1.0 / cosine if cosine > 0.5 else 2.0
