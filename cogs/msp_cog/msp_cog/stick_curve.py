"""From an angle to the stick that demands it in the board's ANGLE mode."""

from typing import ClassVar

from up.quick_dataclass import dataclass

_HALVINGS = 12


@dataclass(frozen=True, slots=True)
class StickCurve:
    """The stick's curve of one axis.

    Betaflight's angle is ``limit_deg`` times the rate that the stick demands over the rate at full
    stick (``pid.c``). ``centre`` and ``full`` are those of ACTUAL rates, 10 deg/s; ``expo`` is in
    percent, ``dead_us`` the stick's dead band.
    """

    ACTUAL_RATES: ClassVar[int] = 3
    limit_deg: float
    centre: float
    full: float
    expo: float
    dead_us: float = 0.0

    def angle_deg(self, stick: float) -> float:
        """Return the angle of a stick beyond its dead band, -1 to 1."""
        return self.limit_deg * self._rate(stick) / (self._rate(1.0) or 1.0)

    def stick_us(self, angle_deg: float) -> int:
        """Return the pulse that demands an angle, as far as the board's limit allows it."""
        wanted, low, high = min(abs(angle_deg), self.limit_deg), 0.0, 1.0
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            if self.angle_deg(middle) < wanted:
                low = middle
            else:
                high = middle
        stick_us = self.dead_us + (500.0 - self.dead_us) * high if wanted else 0.0
        return round(1500.0 + (stick_us if angle_deg >= 0 else -stick_us))

    def _rate(self, stick: float) -> float:
        expo = self.expo / 100
        bent = abs(stick) * (stick**5 * expo + stick * (1 - expo))
        return stick * self.centre + max(0.0, self.full - self.centre) * bent
