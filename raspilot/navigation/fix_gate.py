"""Fixes of a satellite receiver, and the reasons for which one is rejected."""

import math
from collections import Counter

from up.quick_dataclass import dataclass

MAX_ACCURACY_M = 30.0
MAX_AGE_S = 3.5
MIN_INTERVAL_S = 0.05
JUMP_M, JUMP_SIGMA = 25.0, 6.0
REACH_M, MAX_WIND_M_S = 50.0, 20.0
"""A fix is reachable within this distance, at the greatest airspeed with this wind behind."""
PROOF_FIXES, PROOF_S, PROOF_SPREAD_M = 5, 4.0, 20.0


@dataclass(frozen=True, slots=True)
class Fix:
    """A fix at the time when it was taken (monotonic s); unknown values are None."""

    time_s: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float | None = None
    accuracy_m: float | None = None
    speed_m_s: float | None = None
    course_deg: float | None = None

    @property
    def is_valid(self) -> bool:
        """Return whether every value is finite and possible."""
        optional = (self.altitude_m, self.accuracy_m, self.speed_m_s, self.course_deg)
        values = [self.time_s, self.latitude_deg, self.longitude_deg]
        values += [value for value in optional if value is not None]
        if not all(map(math.isfinite, values)):
            return False
        return (
            abs(self.latitude_deg) < 89.0
            and abs(self.time_s) < 1e9
            and abs(self.longitude_deg) <= 180.0
            and -1000.0 <= (self.altitude_m or 0.0) <= 20000.0
            and 0.0 <= (self.speed_m_s or 0.0) <= 150.0
            and (self.accuracy_m or 0.0) >= 0.0
            and abs(self.course_deg or 0.0) <= 360.0
        )

    @property
    def velocity_m_s(self) -> tuple[float, float] | None:
        if self.speed_m_s is None or (self.course_deg is None and self.speed_m_s > 0.5):
            return None
        course = math.radians(self.course_deg or 0.0)
        return self.speed_m_s * math.cos(course), self.speed_m_s * math.sin(course)


def is_far(off_m: float, sd_m: float) -> bool:
    """Return whether this distance from a place of this standard deviation is a jump."""
    return off_m > JUMP_M + JUMP_SIGMA * sd_m


class FixGate:
    """Rejects impossible fixes and counts them by reason in ``rejected``.

    A fix that is far from the expected position is a ``jump``, until ``PROOF_FIXES`` in succession
    over ``PROOF_S`` agree with each other and the aircraft can have flown there: then ``moved`` is
    the answer, and the position is where they are. ``airspeed_m_s`` is the aircraft's greatest.
    """

    def __init__(self, airspeed_m_s: float) -> None:
        self._fastest_m_s = airspeed_m_s + MAX_WIND_M_S
        self.rejected: Counter[str] = Counter()
        self._last: Fix | None = None
        self._accepted_s = 0.0
        self._proofs, self._proof_s, self._proof_m = 0, 0.0, (0.0, 0.0)

    def reason_against(self, fix: Fix, now_s: float, in_flight: bool) -> str | None:
        """Return why a fix is rejected before it is compared with the estimate, and count it.

        ``repeated`` is not counted: the phone repeats a fix until it has the next one.
        """
        reason: str | None = None
        last = self._last
        if not fix.is_valid:
            reason = "invalid"
        elif now_s - fix.time_s > MAX_AGE_S:
            reason = "old"
        elif last is not None and abs(fix.time_s - last.time_s) < MIN_INTERVAL_S:
            return "repeated"
        elif last is not None and fix.time_s < last.time_s:
            reason = "order"
        elif (fix.accuracy_m or 0.0) > MAX_ACCURACY_M:
            reason = "accuracy"
        elif last is not None and in_flight and _is_frozen(last, fix):
            reason = "frozen"
        if reason is not None:
            self.rejected[reason] += 1
        if reason in (None, "frozen"):
            self._last = fix
        return reason

    def judge(self, fix: Fix, north_m: float, east_m: float, sd_m: float, in_flight: bool) -> str:
        """Return ``accepted``, ``jump`` or ``moved`` for a fix this far from the expected place."""
        off_m = math.hypot(north_m, east_m)
        if not is_far(off_m, sd_m):
            self._accept(fix)
            return "accepted"
        spread_m = math.hypot(north_m - self._proof_m[0], east_m - self._proof_m[1])
        if not self._proofs or spread_m > PROOF_SPREAD_M or fix.time_s < self._proof_s:
            self._proofs, self._proof_s = 0, fix.time_s
        self._proofs += 1
        self._proof_m = (north_m, east_m)
        reach_m = REACH_M + self._fastest_m_s * (fix.time_s - self._accepted_s)
        is_proved = self._proofs >= PROOF_FIXES and fix.time_s - self._proof_s >= PROOF_S
        if is_proved and (off_m <= reach_m or not in_flight):
            self._accept(fix)
            return "moved"
        self.rejected["jump"] += 1
        return "jump"

    def _accept(self, fix: Fix) -> None:
        self._accepted_s = fix.time_s
        self._proofs = 0


def _is_frozen(last: Fix, fix: Fix) -> bool:
    """Return whether a moving receiver delivers exactly the same place and speed again."""
    return (
        fix.latitude_deg == last.latitude_deg
        and fix.longitude_deg == last.longitude_deg
        and fix.speed_m_s == last.speed_m_s
        and fix.course_deg == last.course_deg
    )
