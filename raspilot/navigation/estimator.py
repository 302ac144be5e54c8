"""The navigation estimator: position, velocity, wind and airspeed from attitude and late fixes."""

import cmath
import math

from raspilot.navigation.air_path import MAX_GAP_S, AirPath, AirPoint, multiplied
from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.airspeed_model import AirspeedModel
from raspilot.navigation.fix_gate import Fix, FixGate, is_far
from raspilot.navigation.flight_watch import FlightWatch
from raspilot.navigation.horizontal_filter import (
    AIRSPEED_R,
    POSITION_R_M,
    VELOCITY_R_M_S,
    HorizontalFilter,
    unseen_variance,
)
from raspilot.navigation.motor_watch import MotorWatch
from raspilot.navigation.vertical_filter import VerticalFilter
from raspilot.navigation.wind_mean import WindMean
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point

MAX_TIME_S = 1e9
YAW_JUMP_DEG = 20.0
"""Change of the yaw between two frames that is another source or a restart, not a turn."""
COMPASS_SD_DEG, COMPASS_INITIAL_SD_DEG = 60.0, 20.0
"""A compass counts little in each fix, because its error is the same in all of them."""
RECEIVER_SD_M, PRESSURE_SD_M = 2.0, 1.0
"""The slow wander of a receiver, and the pressure's around an aircraft, which no filter sees."""
MIN_WIND_SD_M_S, MIN_AIRSPEED_SD = 0.3, 0.03
GROUND_Q_M, GROUND_SD_M_S = 0.5, 0.3
JUMP_SD_RAD, MOTOR_SD = 0.1, 0.1
FELT_BEGIN_S, FELT_END_S = 0.5, 0.2
"""How long before its arrival an acceleration was felt."""
MEASURED_S = 2.5
"""How long the airspeed that a fix has shown is continued by the model."""
AIRSPEED_SENSOR_R = 0.06
"""Standard deviation, as a part and for one second, of the mean of a sensor."""
SENSOR_FACTOR = 2.0
"""A sensor that is wrong by this factor against the estimate is blocked, or its tube is off."""
SENSED_S = 0.5
"""How long the airspeed of a sensor counts as measured."""
MOVED_SD_M = 10.0
NEW_FRAME_M = 50_000.0


class Estimator:
    """Feed it with ``orientation`` (each frame), ``fix``, and what else exists; ask ``state``.

    All times are of one monotonic clock, in seconds; an input that is not finite is ignored. The
    filters hold the state at the time of the newest fix; ``state`` adds the air path flown since.
    """

    def __init__(self, model: AirframeModel | None = None) -> None:
        model = model or AirframeModel()
        self._model = AirspeedModel(model)
        self._cruise_m_s = model.speeds.cruise_m_s
        self._path = AirPath()
        self._gate = FixGate(model.speeds.maximum_m_s)
        self._flight = FlightWatch()
        self.motor = MotorWatch()
        self.vertical = VerticalFilter()
        self._wind = WindMean()
        self._frame: LocalFrame | None = None
        self._horizontal: HorizontalFilter | None = None
        self._fixed: AirPoint | None = None
        self._velocity_m_s = (0.0, 0.0)
        self._measured: AirPoint | None = None
        self._measured_m_s = 0.0
        self._sensed: AirPoint | None = None
        self._sensed_m_s = 0.0
        self._ratios: list[float] = []
        self._roll_deg = self._pitch_deg = 0.0
        self._throttle = 0.0
        self._compass_offset_rad: float | None = None

    @property
    def rejected(self) -> dict[str, int]:
        """Return how many inputs were rejected, by reason; ``barometer``: its jumps."""
        jumps = self.vertical.jumps
        return {**self._gate.rejected, **({"barometer": jumps} if jumps else {})}

    @property
    def is_in_flight(self) -> bool:
        return self._flight.is_in_flight

    @property
    def fix_time_s(self) -> float | None:
        """Return the time at which the newest accepted fix was taken."""
        return None if self._fixed is None else self._fixed.time_s

    def throttle(self, throttle: float) -> None:
        """Take the throttle that the motor gets, 0 to 1."""
        if math.isfinite(throttle):
            self._throttle = min(1.0, max(0.0, throttle))

    def acceleration(self, time_s: float, forward_m_s2: float) -> None:
        """Take an acceleration along the nose, without gravity."""
        begin, end = (self._path.at(time_s - age_s) for age_s in (FELT_BEGIN_S, FELT_END_S))
        if not self.is_in_flight or begin is None or end is None:
            return
        if not math.isfinite(forward_m_s2):
            return
        if self._horizontal is not None and self._horizontal.is_oriented:
            # The model's own airspeed can be wrong, and then its drag hides a missing thrust.
            forward_m_s2 -= self._model.more_m_s2(abs(self._horizontal.factor))
        gained_m_s = self.motor.acceleration(forward_m_s2, begin, end)
        if gained_m_s is not None:
            self._change_thrust(gained_m_s)

    def airspeed(self, time_s: float, airspeed_m_s: float) -> None:
        """Take a measured true airspeed: the next fix corrects the model by its mean."""
        newest = self._path.newest
        if newest is None or not self.is_in_flight or not math.isfinite(airspeed_m_s):
            return
        modelled_m_s = math.hypot(newest.north_m_s, newest.east_m_s)
        if abs(time_s - newest.time_s) > MAX_GAP_S or modelled_m_s <= 0.0:
            return
        ratio, horizontal = airspeed_m_s / modelled_m_s, self._horizontal
        known = abs(horizontal.factor) if horizontal is not None and horizontal.is_oriented else 1.0
        if not known / SENSOR_FACTOR <= ratio <= known * SENSOR_FACTOR:
            self._gate.rejected["airspeed"] += 1
            return
        self._ratios.append(ratio)
        self._sensed, self._sensed_m_s = newest, airspeed_m_s

    def compass(self, time_s: float, heading_deg: float) -> None:
        """Take a measured heading; it counts little: magnets and motors are near."""
        newest = self._path.newest
        if newest is None or not math.isfinite(heading_deg) or abs(heading_deg) > 360:
            return
        if abs(time_s - newest.time_s) <= MAX_GAP_S:
            self._compass_offset_rad = math.radians(heading_deg - newest.yaw_deg)

    def barometer(self, time_s: float, altitude_m: float, source: str = "") -> None:
        """Take an altitude whose changes are right; the offset of its source is estimated."""
        newest = self._path.newest
        if newest is None or not math.isfinite(altitude_m) or abs(altitude_m) > 30_000:
            return
        if abs(time_s - newest.time_s) <= MAX_GAP_S:
            self.vertical.fuse_barometer(newest.time_s, newest.climb_m, altitude_m, source)

    def orientation(self, time_s: float, roll_deg: float, pitch_deg: float, yaw_deg: float) -> None:
        """Take an attitude and advance the air path to its time."""
        within = -360.0 <= roll_deg <= 360.0 and -360.0 <= pitch_deg <= 360.0
        if not (within and -360.0 <= yaw_deg <= 360.0 and -MAX_TIME_S < time_s < MAX_TIME_S):
            return
        newest, model = self._path.newest, self._model
        yaw = math.radians(yaw_deg)
        cosine, sine = math.cos(yaw), math.sin(yaw)
        if newest is None:
            speed = model.airspeed_m_s
            velocity = speed * cosine, speed * sine
            self._path.append(AirPoint(time_s, 0.0, 0.0, 0.0, 0.0, 0.0, *velocity, yaw_deg))
            return
        dt = time_s - newest.time_s
        if dt <= 0.0:
            return
        turned_deg = math.remainder(yaw_deg - newest.yaw_deg, 360.0)
        if abs(turned_deg) > YAW_JUMP_DEG + 200.0 * min(dt, MAX_GAP_S):
            self._jump(math.radians(turned_deg))
            newest = self._path.newest or newest
        self._roll_deg, self._pitch_deg = roll_deg, pitch_deg
        self._flight.attitude(dt, roll_deg, pitch_deg)
        is_seen = dt <= MAX_GAP_S
        if is_seen:
            model.step(dt, roll_deg, pitch_deg, self._throttle)
        north_m_s, east_m_s = model.airspeed_m_s * cosine, model.airspeed_m_s * sine
        # Trapezoid: the mean of the old and the new velocity through the air.
        point = AirPoint(
            time_s,
            newest.north_m + 0.5 * dt * (newest.north_m_s + north_m_s),
            newest.east_m + 0.5 * dt * (newest.east_m_s + east_m_s),
            newest.climb_m + dt * (model.climb_m_s if self._flight.is_in_flight else 0.0),
            newest.thrust_m_s + dt * model.thrust_m_s2,
            newest.coast_m_s + dt * model.coast_m_s2,
            north_m_s,
            east_m_s,
            yaw_deg,
            newest.unseen_s + (0.0 if is_seen else dt),
        )
        self._path.append(point)

    def fix(self, fix: Fix, now_s: float) -> bool:
        """Take a fix at the time when it was taken; return whether it was accepted."""
        in_flight = self._flight.is_in_flight
        if self._gate.reason_against(fix, now_s, in_flight) is not None:
            return False
        at = self._path.at(fix.time_s)
        if at is None:
            self._gate.rejected["no_orientation"] += 1
            return False
        if self._frame is None or self._horizontal is None or self._fixed is None:
            self._begin(fix, at)
            return True
        point = self._frame.point(fix.latitude_deg, fix.longitude_deg)
        horizontal = self._horizontal
        expected = self._position_at(at) if in_flight else Point(*horizontal.x[:2])
        off = (point.north_m - expected.north_m, point.east_m - expected.east_m)
        sd_m = math.sqrt(horizontal.position_variance(self._fixed, at))
        verdict = self._gate.judge(fix, *off, sd_m, in_flight)
        if verdict == "jump":
            return False
        if verdict == "moved":
            if not in_flight and math.hypot(*point) > NEW_FRAME_M:
                self._begin(fix, at)
                return True
            horizontal.reset_position(*point, MOVED_SD_M)
            self._fixed = at
        velocity = fix.velocity_m_s
        became = self._flight.fix(fix.time_s, velocity)
        if became or not in_flight:
            self._rest(point, at, velocity)
        else:
            self._correct(fix, point, at, velocity)
        if fix.altitude_m is not None:
            self.vertical.fuse_fix(fix.time_s, at.climb_m, fix.altitude_m)
        return True

    def is_far(self, fix: Fix) -> bool | None:
        """Return whether a fix of any source is a jump from the estimate; None: not known."""
        at, fixed = self._path.at(fix.time_s), self._fixed
        if at is None or fixed is None or not (self.is_in_flight and fix.is_valid):
            return None
        assert self._frame is not None and self._horizontal is not None
        point = self._frame.point(fix.latitude_deg, fix.longitude_deg)
        expected = self._position_at(at)
        off_m = math.hypot(point.north_m - expected.north_m, point.east_m - expected.east_m)
        return is_far(off_m, math.sqrt(self._horizontal.position_variance(fixed, at)))

    def state(self) -> NavigationState | None:
        """Return the estimate at the newest orientation; None before a fix."""
        frame, filter_, then = self._frame, self._horizontal, self._fixed
        now = self._path.newest
        if frame is None or filter_ is None or then is None or now is None:
            return None
        altitude_m, climb, altitude_sd = self.vertical.state_at(now.time_s, now.climb_m)
        x, model = filter_.x, self._model
        along, across = filter_.variances()
        speed = model.airspeed_m_s * math.hypot(x[2], x[3])
        offset_rad = math.atan2(x[3], x[2])
        in_flight = self._flight.is_in_flight
        across += unseen_variance(now.unseen_s - then.unseen_s)
        heading_sd = math.degrees(math.sqrt(across)) if filter_.is_oriented else 180.0
        if in_flight:
            position, velocity = self._position_at(now), self._velocity_at(now)
            position_variance = filter_.position_variance(then, now)
            airspeed_sd = speed * math.sqrt(along + MIN_AIRSPEED_SD**2)
            climb += model.climb_m_s
        else:
            position, velocity = Point(x[0], x[1]), Point(*self._velocity_m_s)
            age_s = now.time_s - then.time_s
            position_variance = filter_.p[0][0] + filter_.p[1][1] + (GROUND_SD_M_S * age_s) ** 2
            speed, airspeed_sd, climb = 0.0, model.airspeed_m_s, 0.0
        return NavigationState(
            time_s=now.time_s,
            frame=frame,
            position=position,
            velocity_m_s=velocity,
            altitude_m=altitude_m,
            climb_m_s=climb,
            wind_m_s=Point(self._wind.north_m_s, self._wind.east_m_s),
            airspeed_m_s=speed,
            heading_deg=(now.yaw_deg + math.degrees(offset_rad)) % 360.0,
            roll_deg=self._roll_deg,
            pitch_deg=self._pitch_deg,
            position_sd_m=math.sqrt(position_variance + RECEIVER_SD_M**2),
            altitude_sd_m=math.hypot(altitude_sd, PRESSURE_SD_M),
            wind_sd_m_s=math.sqrt(max(0.0, filter_.p[4][4] + filter_.p[5][5]) + MIN_WIND_SD_M_S**2),
            airspeed_sd_m_s=airspeed_sd,
            heading_sd_deg=heading_sd if heading_sd < 180.0 else 180.0,
            fix_age_s=now.time_s - then.time_s,
            motor_stopped=self.motor.is_stopped,
            motor_watched=self.motor.is_watching(now.time_s),
            measured_airspeed_m_s=self._measured_at(now),
            is_in_flight=in_flight,
        )

    def _measured_at(self, now: AirPoint) -> float | None:
        """Return the airspeed of the last fix, and what the model adds since."""
        sensed = self._sensed
        if sensed is not None and now.time_s - sensed.time_s <= SENSED_S and self.is_in_flight:
            return self._sensed_m_s
        then = self._measured
        if then is None or now.time_s - then.time_s > MEASURED_S or not self.is_in_flight:
            return None
        if now.unseen_s > then.unseen_s:
            return None
        speed = self._measured_m_s + now.coast_m_s - then.coast_m_s
        return speed if self.motor.is_stopped else speed + now.thrust_m_s - then.thrust_m_s

    def _jump(self, turned_rad: float) -> None:
        """Keep the heading although the yaw has jumped."""
        self._multiply(cmath.rect(1.0, turned_rad))
        if self._horizontal is not None:
            self._horizontal.widen(0.0, JUMP_SD_RAD**2)
        self._compass_offset_rad = None

    def _multiply(self, factor: complex) -> None:
        """Multiply the air path by a number, and divide the filter's factor by it."""
        self._path.multiply(factor)
        self._ratios.clear()
        if self._fixed is not None:
            self._fixed = multiplied(self._fixed, factor)
        if self._horizontal is not None:
            self._horizontal.divide(factor)

    def _position_at(self, at: AirPoint) -> Point:
        assert self._horizontal is not None and self._fixed is not None
        x, then = self._horizontal.x, self._fixed
        dt = at.time_s - then.time_s
        north, east = at.north_m - then.north_m, at.east_m - then.east_m
        return Point(
            x[0] + x[2] * north - x[3] * east + x[4] * dt,
            x[1] + x[2] * east + x[3] * north + x[5] * dt,
        )

    def _velocity_at(self, at: AirPoint) -> Point:
        assert self._horizontal is not None
        x, u, v = self._horizontal.x, at.north_m_s, at.east_m_s
        return Point(x[2] * u - x[3] * v + x[4], x[2] * v + x[3] * u + x[5])

    def _begin(self, fix: Fix, at: AirPoint) -> None:
        """Start at a first position: the origin of the frame."""
        self._frame = LocalFrame(fix.latitude_deg, fix.longitude_deg)
        self._horizontal = HorizontalFilter(0.0, 0.0)
        self._fixed = at
        if fix.altitude_m is not None:
            self.vertical.fuse_fix(fix.time_s, at.climb_m, fix.altitude_m)

    def _rest(self, point: Point, at: AirPoint, velocity: tuple[float, float] | None) -> None:
        """Take a fix on the ground, or the first one of the flight."""
        assert self._horizontal is not None and self._fixed is not None
        if self._flight.is_in_flight:
            self._horizontal = HorizontalFilter(*point)
            if self._compass_offset_rad is not None:
                sd_rad = math.radians(COMPASS_INITIAL_SD_DEG)
                self._horizontal.set_offset(self._compass_offset_rad, sd_rad)
            if velocity is not None:
                self._horizontal.fuse_velocity(at, *velocity, VELOCITY_R_M_S)
            self.motor = MotorWatch()
            # Held in a hand the model has lost its airspeed.
            airspeed_m_s = max(self._model.airspeed_m_s, self._cruise_m_s)
            self._model.restart(airspeed_m_s, motor_stopped=False)
            self._wind = WindMean()
        else:
            self._horizontal.blur(GROUND_Q_M * math.sqrt(max(0.0, at.time_s - self._fixed.time_s)))
            self._horizontal.fuse_position(*point, POSITION_R_M)
        self._velocity_m_s = velocity or (0.0, 0.0)
        self._fixed = at

    def _correct(
        self, fix: Fix, point: Point, at: AirPoint, velocity: tuple[float, float] | None
    ) -> None:
        horizontal, then = self._horizontal, self._fixed
        assert horizontal is not None and then is not None
        dt = at.time_s - then.time_s
        horizontal.predict(then, at)
        self._fixed = at
        horizontal.fuse_position(*point, max(POSITION_R_M, 0.5 * (fix.accuracy_m or 0.0)))
        if velocity is not None:
            horizontal.fuse_velocity(at, *velocity, VELOCITY_R_M_S)
        ratios, self._ratios = self._ratios, []
        if dt > 0.0:
            ratio = sum(ratios) / len(ratios) if ratios else 1.0
            deviation = AIRSPEED_SENSOR_R if ratios else AIRSPEED_R
            horizontal.fuse_airspeed(ratio, deviation / math.sqrt(dt))
        if self._compass_offset_rad is not None:
            horizontal.fuse_offset(self._compass_offset_rad, math.radians(COMPASS_SD_DEG))
            self._compass_offset_rad = None
        if velocity is not None and horizontal.is_oriented:
            self._measure_airspeed(at, velocity)
        variance = horizontal.p[4][4] + horizontal.p[5][5]
        self._wind.add(horizontal.x[4], horizontal.x[5], variance, dt)

    def _measure_airspeed(self, at: AirPoint, velocity: tuple[float, float]) -> None:
        """Take the ground velocity less the wind, along the nose."""
        assert self._horizontal is not None
        factor = self._horizontal.factor
        nose = factor * cmath.rect(1.0 / abs(factor), math.radians(at.yaw_deg))
        air = complex(*velocity) - complex(self._wind.north_m_s, self._wind.east_m_s)
        self._measured, self._measured_m_s = at, (air * nose.conjugate()).real

    def _change_thrust(self, gained_m_s: float) -> None:
        """Continue with or without thrust: the airspeed differs by what it has given since."""
        factor = 1.0
        if self._horizontal is not None:
            # The path is that of the estimate until now: a factor of length 1.
            factor = abs(self._horizontal.factor)
            self._multiply(complex(factor))
            self._horizontal.widen(MOTOR_SD**2, 0.0)
        airspeed_m_s = self._model.airspeed_m_s * factor + gained_m_s
        self._model.restart(airspeed_m_s, motor_stopped=self.motor.is_stopped)
