"""The Kalman filter of position, heading offset, airspeed factor and wind."""

import math

from raspilot.navigation.air_path import AirPoint
from raspilot.navigation.limits import limited

POSITION_R_M = 2.0
VELOCITY_R_M_S = 0.4
POSITION_Q_M, AIRSPEED_Q, THRUST_Q, YAW_Q_RAD, WIND_Q_M_S = 0.7, 0.012, 0.02, 0.012, 0.12
"""Standard deviations after a second. The position's is how fast a receiver's error wanders, the
airspeed's a part of it; ``THRUST_Q`` is added for each m/s that the motor has given."""
GUST_M_S = 0.7
"""Standard deviation of each axis of what slow gusts add to the wind until the next fix."""
UNSEEN_M_S, UNSEEN_RAD_S = 5.0, 0.5
"""Standard deviations, for each second without orientation, of the motion and of the turn."""
AIRSPEED_R = 0.25
"""Standard deviation, for one second, of the knowledge that the airspeed model is right."""
WIND_SD_M_S, FACTOR_SD, POSITION_SD_M = 5.0, 0.15, 10.0
"""Standard deviations before the first fix in flight."""
LIMIT_SIGMA = 5.0
"""Innovations beyond are cut to this."""
MIN_FACTOR = 0.3
MAX_SD_M, MAX_WIND_SD_M_S = 1e5, 15.0
# Of both axes, once: each state needs them.
_FACTOR_Q, _POSITION_Q = AIRSPEED_Q**2 + YAW_Q_RAD**2, 2.0 * POSITION_Q_M**2
_GUST, _WIND_Q, _MAX_VARIANCE = 2.0 * GUST_M_S**2, 2.0 * WIND_Q_M_S**2, 2.0 * MAX_SD_M**2


class HorizontalFilter:
    """Linear, apart from the knowledge of the airspeed: it converges from any heading offset.

    The air path of the board's yaw and the modelled airspeed is a complex number (north + i east);
    the state is the position, the factor ``a + ib`` by which the path is turned and stretched, and
    the wind, all at the time of the last fix:

        position' = position + (a + ib) * path + wind * time

    The angle of the factor is the yaw's offset; its length is the airspeed over the modelled one.
    """

    def __init__(self, north_m: float, east_m: float) -> None:
        self.x = [north_m, east_m, 0.0, 0.0, 0.0, 0.0]
        self.p = _diagonal(POSITION_SD_M, POSITION_SD_M, 1.0, 1.0, WIND_SD_M_S, WIND_SD_M_S)

    @property
    def factor(self) -> complex:
        return complex(self.x[2], self.x[3])

    @property
    def is_oriented(self) -> bool:
        return abs(complex(self.x[2], self.x[3])) > MIN_FACTOR

    def set_offset(self, offset_rad: float, sd_rad: float) -> None:
        """Start with a known offset of the yaw, for example from a compass."""
        self.x[2], self.x[3] = math.cos(offset_rad), math.sin(offset_rad)
        self.p[2][2] = self.p[3][3] = self.p[2][3] = self.p[3][2] = 0.0
        self.widen(FACTOR_SD**2, sd_rad**2)

    def divide(self, factor: complex) -> None:
        """Divide the factor of the path by a number by which the path was multiplied."""
        inverse = 1.0 / factor
        c, s = inverse.real, inverse.imag
        rows = self.p
        for row in [self.x, *rows]:
            row[2], row[3] = row[2] * c - row[3] * s, row[2] * s + row[3] * c
        for k in range(6):
            above, below = rows[2][k], rows[3][k]
            rows[2][k], rows[3][k] = above * c - below * s, above * s + below * c

    def widen(self, along: float, across: float) -> None:
        """Add variances of the factor along (airspeed) and across itself (heading)."""
        a, b = self.x[2], self.x[3]
        length = math.hypot(a, b)
        a, b = (a / length, b / length) if length > 0.0 else (1.0, 0.0)
        rows = self.p
        rows[2][2] += a * a * along + b * b * across
        rows[3][3] += b * b * along + a * a * across
        cross = a * b * (along - across)
        rows[2][3] += cross
        rows[3][2] += cross

    def predict(self, then: AirPoint, now: AirPoint) -> None:
        """Move the state from one point of the air path to a later one."""
        dt = now.time_s - then.time_s
        north, east = now.north_m - then.north_m, now.east_m - then.east_m
        x, rows = self.x, self.p
        a, b = x[2], x[3]
        x[0] += a * north - b * east + x[4] * dt
        x[1] += a * east + b * north + x[5] * dt
        r0, r1, r2, r3, r4, r5 = rows
        for k in range(6):
            two, three = r2[k], r3[k]
            r0[k] += north * two - east * three + dt * r4[k]
            r1[k] += east * two + north * three + dt * r5[k]
        for row in rows:
            two, three = row[2], row[3]
            row[0] += north * two - east * three + dt * row[4]
            row[1] += east * two + north * three + dt * row[5]
        # What the random walks of factor and wind add within the interval to the position.
        thrust = now.thrust_m_s - then.thrust_m_s
        radial = AIRSPEED_Q**2 * dt + (THRUST_Q * thrust) ** 2 / dt if dt > 0 else 0.0
        across = YAW_Q_RAD**2 * dt
        wind = WIND_Q_M_S**2 * dt
        unseen_s = now.unseen_s - then.unseen_s
        path = north * north + east * east
        drift = POSITION_Q_M**2 * dt + (wind * dt * dt + max(radial, across) * path) / 3.0
        drift += (UNSEEN_M_S * unseen_s) ** 2
        r0[0] = min(r0[0] + drift, MAX_SD_M**2)
        r1[1] = min(r1[1] + drift, MAX_SD_M**2)
        if r4[4] < MAX_WIND_SD_M_S**2:
            r4[4] += wind
            r5[5] += wind
        turned = unseen_variance(unseen_s)
        self.widen(radial + turned * turned, across + turned)

    def fuse_position(self, north_m: float, east_m: float, sd_m: float) -> None:
        variance = sd_m * sd_m
        for index, measured in ((0, north_m), (1, east_m)):
            column = [row[index] for row in self.p]
            self._correct(column, column[index] + variance, measured - self.x[index])

    def fuse_velocity(self, at: AirPoint, north_m_s: float, east_m_s: float, sd_m_s: float) -> None:
        x, u, v = self.x, at.north_m_s, at.east_m_s
        variance = sd_m_s * sd_m_s
        column = [u * row[2] - v * row[3] + row[4] for row in self.p]
        total = u * column[2] - v * column[3] + column[4] + variance
        self._correct(column, total, north_m_s - (x[2] * u - x[3] * v + x[4]))
        column = [v * row[2] + u * row[3] + row[5] for row in self.p]
        total = v * column[2] + u * column[3] + column[5] + variance
        self._correct(column, total, east_m_s - (x[2] * v + x[3] * u + x[5]))

    def fuse_airspeed(self, factor: float, sd: float) -> None:
        """Fuse the airspeed over the modelled one: from a sensor, or 1 from the model itself."""
        a, b = self.x[2], self.x[3]
        length = math.hypot(a, b)
        if length < MIN_FACTOR:
            return
        a, b = a / length, b / length
        column = [a * row[2] + b * row[3] for row in self.p]
        self._correct(column, a * column[2] + b * column[3] + sd * sd, factor - length)

    def fuse_offset(self, offset_rad: float, sd_rad: float) -> None:
        """Fuse an offset of the yaw: the compass minus the yaw."""
        a, b = self.x[2], self.x[3]
        length = math.hypot(a, b)
        if length < MIN_FACTOR:
            return
        error = math.remainder(offset_rad - math.atan2(b, a), 2 * math.pi) * length
        a, b = -b / length, a / length
        column = [a * row[2] + b * row[3] for row in self.p]
        variance = (sd_rad * length) ** 2
        self._correct(column, a * column[2] + b * column[3] + variance, error)

    def variances(self) -> tuple[float, float]:
        """Return those of the factor: along (airspeed) and across (heading), as parts of it."""
        a, b = self.x[2], self.x[3]
        squared = a * a + b * b
        aa, ab, bb = self.p[2][2], self.p[2][3], self.p[3][3]
        if squared < MIN_FACTOR**2:
            return aa + bb, aa + bb
        along = (a * a * aa + 2 * a * b * ab + b * b * bb) / (squared * squared)
        across = (b * b * aa - 2 * a * b * ab + a * a * bb) / (squared * squared)
        return along if along > 0.0 else 0.0, across if across > 0.0 else 0.0

    def position_variance(self, then: AirPoint, now: AirPoint) -> float:
        """Return the sum of both axes' variances at a later point of the air path."""
        dt = now.time_s - then.time_s
        north, east = now.north_m - then.north_m, now.east_m - then.east_m
        r0, r1, r2, r3, r4, r5 = self.p
        path = north * north + east * east
        total = r0[0] + r1[1] + path * (r2[2] + r3[3]) + dt * dt * (r4[4] + r5[5])
        total += 2.0 * north * (r0[2] + r1[3]) + 2.0 * east * (r1[2] - r0[3])
        total += 2.0 * dt * (r0[4] + r1[5])
        total += 2.0 * dt * (north * (r2[4] + r3[5]) + east * (r2[5] - r3[4]))
        thrust = now.thrust_m_s - then.thrust_m_s
        if dt > 0.0:
            factor = _FACTOR_Q * dt + (THRUST_Q * thrust) ** 2 / dt
            total += _POSITION_Q * dt + _GUST * dt * dt
            total += (_WIND_Q * dt * dt * dt + factor * path) / 3.0
            total += 2.0 * (UNSEEN_M_S * (now.unseen_s - then.unseen_s)) ** 2
        return limited(total, 0.0, _MAX_VARIANCE)

    def blur(self, sd_m: float) -> None:
        for index in (0, 1):
            self.p[index][index] = min(self.p[index][index] + sd_m * sd_m, MAX_SD_M**2)

    def reset_position(self, north_m: float, east_m: float, sd_m: float) -> None:
        """Put the position elsewhere; wind and factor stay."""
        self.x[0], self.x[1] = north_m, east_m
        for index in (0, 1):
            for k in range(6):
                self.p[index][k] = self.p[k][index] = 0.0
            self.p[index][index] = sd_m * sd_m

    def _correct(self, column: list[float], variance: float, innovation: float) -> None:
        """Apply one scalar measurement: the column is P Hᵀ, the variance that of the innovation."""
        limit = LIMIT_SIGMA * math.sqrt(variance)
        innovation = limited(innovation, -limit, limit)
        c0, c1, c2, c3, c4, c5 = column
        gain = innovation / variance
        x = self.x
        x[0] += c0 * gain
        x[1] += c1 * gain
        x[2] += c2 * gain
        x[3] += c3 * gain
        x[4] += c4 * gain
        x[5] += c5 * gain
        for row, each in zip(self.p, column, strict=True):
            part = each / variance
            row[0] -= part * c0
            row[1] -= part * c1
            row[2] -= part * c2
            row[3] -= part * c3
            row[4] -= part * c4
            row[5] -= part * c5


def unseen_variance(unseen_s: float) -> float:
    """Return that of the heading (rad squared) after a time without orientation."""
    return min(1.0, (UNSEEN_RAD_S * unseen_s) ** 2) if unseen_s else 0.0


def _diagonal(*deviations: float) -> list[list[float]]:
    size = len(deviations)
    return [[deviations[i] ** 2 if i == k else 0.0 for k in range(size)] for i in range(size)]
