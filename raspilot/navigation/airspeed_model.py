"""The airspeed and the climb that pitch, bank and throttle cause; no sensor of the air needed."""

from __future__ import annotations

import math
from dataclasses import dataclass

from up.flight_modes.navigation_file import Airspeed, Performance

GRAVITY_M_S2 = 9.80665


@dataclass(frozen=True, slots=True)
class Airframe:
    """What the model has to know; the names are those of ``navigation.yml``.

    The defaults are the simulator's glider. Errors of 15 % are corrected in flight.
    """

    stall_m_s: float = 6.5
    best_glide_m_s: float = 8.0
    cruise_m_s: float = 11.0
    glide_ratio: float = 13.5
    level_throttle: float = 0.49
    full_throttle_climb_m_s: float = 4.0
    cruise_pitch_deg: float = 0.4
    stall_pitch_deg: float = 7.5


def airframe_of(airspeed: Airspeed, performance: Performance) -> Airframe:
    """Return the numbers of ``navigation.yml``."""
    return Airframe(
        airspeed.stall_m_s,
        airspeed.best_glide_m_s,
        airspeed.cruise_m_s,
        performance.glide_ratio,
        performance.level_throttle,
        performance.full_throttle_climb_m_s,
        performance.cruise_pitch_deg,
        performance.stall_pitch_deg,
    )


class AirspeedModel:
    """Integrates the airspeed from the energy: thrust, a parabolic polar, and the climb.

    The angle of attack of the present lift gives the climb from the pitch. ``thrust_m_s2`` is the
    thrust over the mass of a working motor; without ``has_thrust`` it does not act.
    """

    def __init__(self, airframe: Airframe, has_thrust: bool = True) -> None:
        stall, cruise = airframe.stall_m_s, airframe.cruise_m_s
        self.airspeed_m_s = cruise
        self.climb_m_s = 0.0
        self.thrust_m_s2 = 0.0
        self._has_thrust = has_thrust
        self._slowest, self._fastest = 0.85 * stall, 2.5 * cruise
        stall_rad = math.radians(airframe.stall_pitch_deg)
        cruise_rad = math.radians(airframe.cruise_pitch_deg)
        self._lift = (stall_rad - cruise_rad) / (stall**-2 - cruise**-2)
        self._zero_lift_rad = cruise_rad - self._lift * cruise**-2
        self._drag = 0.5 / airframe.glide_ratio
        self._best_squared = airframe.best_glide_m_s**2
        level, power = airframe.level_throttle, cruise * self._drag_of(cruise, 1.0)
        # Power over weight: quadratic through the level flight and the climb at full throttle.
        full = power + airframe.full_throttle_climb_m_s
        self._power_2 = (power / level - full) / (level - 1.0)
        self._power_1 = full - self._power_2

    def step(self, dt_s: float, roll_rad: float, pitch_rad: float, throttle: float) -> None:
        """Advance; ``climb_m_s`` is then the climb through the air."""
        speed = self.airspeed_m_s
        cosine = math.cos(roll_rad)
        attack = self._zero_lift_rad * cosine + self._lift / (speed * speed)
        sine = math.sin(pitch_rad - attack)
        self.climb_m_s = speed * sine
        thrust = 0.0
        if throttle > 0.0:
            power = throttle * (self._power_2 * throttle + self._power_1)
            if power > 0.0:
                thrust = power / speed
        self.thrust_m_s2 = GRAVITY_M_S2 * thrust
        if not self._has_thrust:
            thrust = 0.0
        load = 1.0 / cosine if cosine > 0.5 else 2.0
        total = thrust - self._drag_of(speed, load) - sine
        speed += GRAVITY_M_S2 * total * dt_s
        if speed < self._slowest:
            speed = self._slowest
        elif speed > self._fastest:
            speed = self._fastest
        self.airspeed_m_s = speed

    def _drag_of(self, speed: float, load: float) -> float:
        """Return drag over weight."""
        part = speed * speed / self._best_squared
        return self._drag * (part + load * load / part)
