"""Whether the aircraft flies or rests on the ground."""

import math

TAKE_OFF_M_S, TAKE_OFF_FIXES = 5.0, 2
LANDED_M_S, LANDED_S = 2.0, 10.0
STILL_DEG_S = 3.0
STILL_TAU_S = 3.0


class FlightWatch:
    """In flight after ``TAKE_OFF_FIXES`` faster than ``TAKE_OFF_M_S``.

    On the ground after ``LANDED_S`` of fixes below ``LANDED_M_S`` while the attitude is still: an
    aircraft that stands in the air against the wind always moves a little. Fixes without velocity
    change nothing.
    """

    def __init__(self) -> None:
        self.is_in_flight = False
        self._fast = 0
        self._slow_since_s: float | None = None
        self._motion_deg_s = 100.0
        self._attitude_deg = (0.0, 0.0)

    def attitude(self, dt_s: float, roll_deg: float, pitch_deg: float) -> None:
        before_deg, self._attitude_deg = self._attitude_deg, (roll_deg, pitch_deg)
        moved = abs(math.remainder(roll_deg - before_deg[0], 360.0)) + abs(
            pitch_deg - before_deg[1]
        )
        share = dt_s / STILL_TAU_S if dt_s < STILL_TAU_S else 1.0
        self._motion_deg_s += share * (moved / dt_s - self._motion_deg_s)

    def fix(self, time_s: float, velocity_m_s: tuple[float, float] | None) -> bool:
        """Take the ground velocity of a fix; return whether the flight begins with it."""
        if velocity_m_s is None:
            return False
        speed_m_s = math.hypot(*velocity_m_s)
        if not self.is_in_flight:
            self._fast = self._fast + 1 if speed_m_s > TAKE_OFF_M_S else 0
            self.is_in_flight = self._fast >= TAKE_OFF_FIXES
            self._slow_since_s = None
            return self.is_in_flight
        self._fast = 0
        if speed_m_s > LANDED_M_S or self._motion_deg_s > STILL_DEG_S:
            self._slow_since_s = None
        elif self._slow_since_s is None:
            self._slow_since_s = time_s
        elif time_s - self._slow_since_s >= LANDED_S:
            self.is_in_flight = False
        return False
