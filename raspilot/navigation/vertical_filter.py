"""The Kalman filter of altitude, climb error and barometer offset."""

from __future__ import annotations

import math

FIX_R_M, WITH_BAROMETER_R_M, BAROMETER_R_M = 2.0, 15.0, 0.7
"""Of a fix, without and with a barometer, and of the barometer. With one, the receiver's slow
wander must not move the altitude: its fixes of one second count as white noise of 15 m.
"""
BAROMETER_LOST_S = 5.0
ALTITUDE_Q_M, CLIMB_Q_M_S, OFFSET_Q_M = 1.1, 0.3, 0.05
"""Standard deviations after a second: how fast a receiver's altitude wanders, the climb error's,
the barometer's offset's."""
WITH_BAROMETER_Q_M = 0.1
ALTITUDE_SD_M, CLIMB_SD_M_S, OFFSET_SD_M = 1000.0, 1.0, 200.0
CLIMB_TAU_S = 20.0
"""The climb error returns to zero with this time constant where nothing measures it."""
LIMIT_SIGMA = 5.0
MAX_VARIANCE = 1e6


class VerticalFilter:
    """Altitude above sea level at the time of the newest measurement; the barometer's is relative.

    ``climb_m`` is the running integral of the modelled climb (``AirPoint``): the state is the
    altitude, the error of the modelled climb, and the barometer's offset.
    """

    def __init__(self) -> None:
        self.altitude_m = self.climb_error_m_s = self.offset_m = 0.0
        self._time_s: float | None = None
        self._climb_m = 0.0
        self._p = [
            [ALTITUDE_SD_M**2, 0.0, 0.0],
            [0.0, CLIMB_SD_M_S**2, 0.0],
            [0.0, 0.0, OFFSET_SD_M**2],
        ]
        self._barometer_s = -math.inf

    def altitude_at(self, time_s: float, climb_m: float) -> float:
        passed_s = 0.0 if self._time_s is None else time_s - self._time_s
        return self.altitude_m + climb_m - self._climb_m + self.climb_error_m_s * passed_s

    def sd_at(self, time_s: float) -> float:
        dt = 0.0 if self._time_s is None else max(0.0, time_s - self._time_s)
        p = self._p
        total = p[0][0] + 2.0 * dt * p[0][1] + dt * dt * p[1][1]
        total += ALTITUDE_Q_M**2 * dt + CLIMB_Q_M_S**2 * dt * dt * dt / 3.0
        return math.sqrt(min(max(total, 0.0), MAX_VARIANCE))

    @property
    def climb_sd_m_s(self) -> float:
        return math.sqrt(max(self._p[1][1], 0.0))

    def fuse_fix(self, taken_s: float, climb_then_m: float, altitude_m: float) -> None:
        """Fuse a fix that was taken in the past: it is compared with the altitude at that time."""
        lag_s = 0.0 if self._time_s is None else max(0.0, self._time_s - taken_s)
        if lag_s == 0.0:
            self._advance(taken_s, climb_then_m)
        elif self._p[0][0] >= ALTITUDE_SD_M**2:
            lag_s = 0.0
        error = altitude_m - self.altitude_at(taken_s, climb_then_m)
        sd_m = WITH_BAROMETER_R_M if self._has_barometer(taken_s) else FIX_R_M
        self._correct(1.0, -lag_s, 0.0, error, sd_m)

    def fuse_barometer(self, time_s: float, climb_m: float, altitude_m: float) -> None:
        self._barometer_s = time_s
        self._advance(time_s, climb_m)
        error = altitude_m - self.altitude_m - self.offset_m
        self._correct(1.0, 0.0, 1.0, error, BAROMETER_R_M)

    def _has_barometer(self, time_s: float) -> bool:
        return time_s - self._barometer_s < BAROMETER_LOST_S

    def _advance(self, time_s: float, climb_m: float) -> None:
        if self._time_s is None:
            self._time_s, self._climb_m = time_s, climb_m
            return
        dt = time_s - self._time_s
        if dt <= 0.0:
            return
        self.altitude_m = self.altitude_at(time_s, climb_m)
        self._time_s, self._climb_m = time_s, climb_m
        keep = max(0.0, 1.0 - dt / CLIMB_TAU_S)
        self.climb_error_m_s *= keep
        p0, p1, p2 = self._p
        noise = WITH_BAROMETER_Q_M if self._has_barometer(time_s) else ALTITUDE_Q_M
        p0[0] += 2.0 * dt * p0[1] + dt * dt * p1[1] + noise**2 * dt + CLIMB_Q_M_S**2 * dt**3 / 3.0
        p0[0] = min(p0[0], MAX_VARIANCE)
        p0[1] = p1[0] = (p0[1] + dt * p1[1]) * keep
        p0[2] = p2[0] = p0[2] + dt * p1[2]
        p1[1] = p1[1] * keep * keep + CLIMB_Q_M_S**2 * dt
        p1[2] = p2[1] = p1[2] * keep
        p2[2] = min(p2[2] + OFFSET_Q_M**2 * dt, MAX_VARIANCE)

    def _correct(self, h0: float, h1: float, h2: float, innovation: float, sd: float) -> None:
        column = [h0 * row[0] + h1 * row[1] + h2 * row[2] for row in self._p]
        c0, c1, c2 = column
        variance = h0 * c0 + h1 * c1 + h2 * c2 + sd * sd
        limit = LIMIT_SIGMA * math.sqrt(variance)
        gain = max(-limit, min(limit, innovation)) / variance
        self.altitude_m += c0 * gain
        self.climb_error_m_s += c1 * gain
        self.offset_m += c2 * gain
        for row, each in zip(self._p, column, strict=True):
            part = each / variance
            row[0] -= part * c0
            row[1] -= part * c1
            row[2] -= part * c2
