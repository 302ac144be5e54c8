"""The Kalman filter of altitude, climb error, and the offsets of barometer and receiver."""

import math

from raspilot.navigation.limits import limited

FIX_R_M, BAROMETER_R_M = 1.3, 0.7
"""White noise of one measurement; how far a receiver's altitude wanders is ``ALTITUDE_Q_M``."""
WITH_BAROMETER_R_M = 22.0
"""Beside a barometer the fixes only show the mean: their wander counts as white noise."""
BAROMETER_LOST_S = 5.0
ALTITUDE_Q_M, CLIMB_Q_M_S = 1.1, 0.4
"""Standard deviations after a second: how fast a receiver's altitude wanders, the climb error's."""
WITH_BAROMETER_Q_M = 0.1
MEAN_Q_M = 0.4
"""Until the altitude is held it follows the mean of the last minutes' fixes."""
WEATHER_Q_M = 0.03
"""Of the barometer's offset: fixes move a held altitude slower than the weather does."""
ALTITUDE_SD_M, CLIMB_SD_M_S, OFFSET_SD_M, RECEIVER_SD_M = 1000.0, 1.0, 200.0, 3.0
CLIMB_TAU_S = 10.0
"""The climb error, mostly rising and sinking air, returns to zero with this time constant."""
RISING_M_S = 0.75
"""Standard deviation of what slowly rising air adds to the climb until the next measurement."""
LIMIT_SIGMA = 5.0
MAX_VARIANCE = 1e6
JUMP_M, JUMP_M_S = 5.0, 15.0
"""A barometer that changes by more than this, and by this each second, has another offset."""
OFF_M, OFF_TAU_S, OFF_FIX_S = 20.0, 10.0, 1.0
"""Fixes that differ by more for this long are believed instead of the barometer; one alone counts
for at most a second, also after a time without fixes."""
ALTITUDE, CLIMB, OFFSET, RECEIVER = range(4)


class VerticalFilter:
    """Altitude above sea level at the time of the newest measurement.

    ``climb_m`` is the running integral of the modelled climb (``AirPoint``): the state is the
    altitude, the error of the modelled climb, the offset of the barometer and that of the receiver.

    While it is held the barometer's offset is right by definition, whatever the receiver's error
    was when it was found: altitudes have a constant error, heights above a home of this time have
    none. Only the mean of many minutes of fixes moves it, as the weather does. An offset belongs to
    the barometer named ``source``.
    """

    def __init__(self) -> None:
        self._x = [0.0, 0.0, 0.0, 0.0]
        deviations = (ALTITUDE_SD_M, CLIMB_SD_M_S, OFFSET_SD_M, RECEIVER_SD_M)
        self._p = [[0.0] * 4 for _ in deviations]
        for index, sd in enumerate(deviations):
            self._p[index][index] = sd * sd
        self._time_s: float | None = None
        self._climb_m = 0.0
        self._barometer_s = -math.inf
        self._off_m, self._off_s = 0.0, -math.inf
        self._is_known = self._is_pinned = self._is_held = False
        self.source: str | None = None
        self.jumps = 0

    @property
    def altitude_m(self) -> float:
        return self._x[ALTITUDE]

    @property
    def held_offset_m(self) -> float | None:
        """Return the barometer's altitude less this one, once that is held."""
        return self._x[OFFSET] if self._is_pinned else None

    def altitude_at(self, time_s: float, climb_m: float) -> float:
        error_m = self._x[CLIMB] * _reach_s(self._passed_s(time_s))
        return self.altitude_m + climb_m - self._climb_m + error_m

    def state_at(self, time_s: float, climb_m: float) -> tuple[float, float, float]:
        """Return the altitude, what the modelled climb lacks (m/s), and the altitude's deviation.

        While the altitude is held, that is without its constant error.
        """
        x, (altitude, climb, *_) = self._x, self._p
        dt = 0.0 if self._time_s is None else time_s - self._time_s
        kept = math.exp(-dt / CLIMB_TAU_S)
        reach_s = CLIMB_TAU_S * (1.0 - kept)
        altitude_m = x[ALTITUDE] + climb_m - self._climb_m + x[CLIMB] * reach_s
        if dt < 0.0:
            dt = reach_s = 0.0
        total = altitude[0] + 2.0 * reach_s * altitude[1] + reach_s * reach_s * climb[1]
        total += ALTITUDE_Q_M**2 * dt + _climbed_variance(dt, reach_s) + (RISING_M_S * dt) ** 2
        return altitude_m, x[CLIMB] * kept, math.sqrt(limited(total, 0.0, MAX_VARIANCE))

    def hold(self, is_held: bool) -> None:
        """Hold the altitude from now on, or let it follow the mean of the fixes again."""
        if self._is_pinned and not is_held:
            self._is_pinned = False
            self._x[RECEIVER] = 0.0
            self._forget(RECEIVER, 0.0)
            self._widen((1.0, 0.0, -1.0, -1.0), RECEIVER_SD_M**2)
        self._is_held = is_held

    def resume(self, source: str, offset_m: float) -> None:
        """Continue with the offset that another run of the program has held."""
        if self.source is not None:
            self._shift(self._x[OFFSET] - offset_m)
        self._x[OFFSET], self.source = offset_m, source
        self._forget(OFFSET, 0.0)
        self._is_held = self._is_pinned = True

    def fuse_fix(self, taken_s: float, climb_then_m: float, altitude_m: float) -> None:
        """Fuse a fix that was taken in the past: it is compared with the altitude at that time."""
        lag_s = 0.0 if self._time_s is None else max(0.0, self._time_s - taken_s)
        if lag_s == 0.0:
            self._advance(taken_s, climb_then_m)
        error = altitude_m - self.altitude_at(taken_s, climb_then_m) - self._x[RECEIVER]
        sd_m = FIX_R_M
        if not self._is_known:
            self._is_known, lag_s = True, 0.0
            self._x[ALTITUDE] += error
            if not self._is_pinned:
                self._x[OFFSET] -= error
            error = 0.0
        elif self._has_barometer(taken_s):
            sd_m = WITH_BAROMETER_R_M
            error = self._agreed(taken_s, error)
        self._correct((1.0, _reach_s(-lag_s), 0.0, 1.0), error, sd_m)

    def fuse_barometer(
        self, time_s: float, climb_m: float, altitude_m: float, source: str = ""
    ) -> None:
        passed_s = time_s - self._barometer_s
        self._barometer_s = time_s
        self._advance(time_s, climb_m)
        error = altitude_m - self.altitude_m - self._x[OFFSET]
        if source != self.source:
            self.source, self._is_pinned = source, False
            self._x[OFFSET] += error
            self._forget(OFFSET, OFFSET_SD_M**2)
            error = 0.0
        elif self._is_known and abs(error) > JUMP_M + JUMP_M_S * passed_s:
            self._x[OFFSET] += error
            self.jumps += 1
            error = 0.0
        self._correct((1.0, 0.0, 1.0, 0.0), error, BAROMETER_R_M)
        if self._is_pinned:
            self._is_known = True
        elif self._is_held and self._is_known:
            self._pin()

    def _pin(self) -> None:
        """Make the offset right: its error becomes one of the altitude and of the receiver."""
        rows = self._p
        for k in range(4):
            rows[ALTITUDE][k] += rows[OFFSET][k]
            rows[RECEIVER][k] -= rows[OFFSET][k]
        for row in rows:
            row[ALTITUDE] += row[OFFSET]
            row[RECEIVER] -= row[OFFSET]
        self._forget(OFFSET, 0.0)
        rows[RECEIVER][RECEIVER] += RECEIVER_SD_M**2
        self._is_pinned = True

    def _forget(self, index: int, variance: float) -> None:
        for k in range(4):
            self._p[index][k] = self._p[k][index] = 0.0
        self._p[index][index] = variance

    def _widen(self, direction: tuple[float, ...], variance: float) -> None:
        for row, a in zip(self._p, direction, strict=True):
            for k, b in enumerate(direction):
                row[k] += a * b * variance

    def _shift(self, up_m: float) -> None:
        self._x[ALTITUDE] += up_m
        self._x[OFFSET] -= up_m

    def _agreed(self, time_s: float, error: float) -> float:
        """Believe the fixes if the barometer has left them; return the error that remains."""
        dt = max(0.0, time_s - self._off_s)
        if dt > BAROMETER_LOST_S:
            self._off_m = 0.0
        self._off_s = time_s
        self._off_m += (error - self._off_m) * min(OFF_FIX_S, dt) / OFF_TAU_S
        if abs(self._off_m) <= OFF_M:
            return error
        self._shift(self._off_m)
        error -= self._off_m
        self._off_m = 0.0
        self.jumps += 1
        return error

    def _passed_s(self, time_s: float) -> float:
        return 0.0 if self._time_s is None else time_s - self._time_s

    def _has_barometer(self, time_s: float) -> bool:
        return time_s - self._barometer_s < BAROMETER_LOST_S

    def _advance(self, time_s: float, climb_m: float) -> None:
        if self._time_s is None:
            self._time_s, self._climb_m = time_s, climb_m
            return
        dt = time_s - self._time_s
        if dt <= 0.0:
            return
        self._x[ALTITUDE] = self.altitude_at(time_s, climb_m)
        self._time_s, self._climb_m = time_s, climb_m
        keep = math.exp(-dt / CLIMB_TAU_S)
        reach_s = CLIMB_TAU_S * (1.0 - keep)
        self._x[CLIMB] *= keep
        p = self._p
        altitude, climb = p[ALTITUDE], p[CLIMB]
        for k in range(4):
            altitude[k] += reach_s * climb[k]
            climb[k] *= keep
        for row in p:
            row[0] += reach_s * row[1]
            row[1] *= keep
        noise = ALTITUDE_Q_M
        if self._has_barometer(time_s):
            noise = WITH_BAROMETER_Q_M
            if not self._is_pinned:
                self._widen((1.0, 0.0, -1.0, 0.0), MEAN_Q_M**2 * dt)
        p[0][0] = min(p[0][0] + noise**2 * dt + _climbed_variance(dt, reach_s), MAX_VARIANCE)
        p[0][1] += 0.5 * CLIMB_Q_M_S**2 * reach_s * reach_s
        p[1][0] = p[0][1]
        p[1][1] += 0.5 * CLIMB_Q_M_S**2 * CLIMB_TAU_S * (1.0 - keep * keep)
        p[2][2] = min(p[2][2] + WEATHER_Q_M**2 * dt, MAX_VARIANCE)

    def _correct(self, h: tuple[float, float, float, float], innovation: float, sd: float) -> None:
        h0, h1, h2, h3 = h
        column = [h0 * row[0] + h1 * row[1] + h2 * row[2] + h3 * row[3] for row in self._p]
        c0, c1, c2, c3 = column
        variance = h0 * c0 + h1 * c1 + h2 * c2 + h3 * c3 + sd * sd
        limit = LIMIT_SIGMA * math.sqrt(variance)
        gain = limited(innovation, -limit, limit) / variance
        x = self._x
        x[0] += c0 * gain
        x[1] += c1 * gain
        x[2] += c2 * gain
        x[3] += c3 * gain
        for row, each in zip(self._p, column, strict=True):
            part = each / variance
            row[0] -= part * c0
            row[1] -= part * c1
            row[2] -= part * c2
            row[3] -= part * c3


def _reach_s(passed_s: float) -> float:
    """Return how far a climb error of 1 m/s leads until it has returned to zero."""
    return CLIMB_TAU_S * (1.0 - math.exp(-passed_s / CLIMB_TAU_S))


def _climbed_variance(dt: float, reach_s: float) -> float:
    """Return the altitude's (m squared), of the climb error's noise in this time."""
    return (CLIMB_Q_M_S * CLIMB_TAU_S) ** 2 * (dt - reach_s - 0.5 * reach_s**2 / CLIMB_TAU_S)
