"""The flight dynamics: an airframe's flight model, its servos, its drive, in the weather."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

from up_rig.imu import Motion
from up_simulator.aircraft.airframe import Airframe
from up_simulator.aircraft.flight import FlightState, Servos
from up_simulator.aircraft.ground import GroundRun, is_soft
from up_simulator.aircraft.model import FOOT_M, FlightModel, ModelChoice, chosen_model, load_model
from up_simulator.aircraft.model_check import MOTOR
from up_simulator.aircraft.motor import Battery, Motor
from up_simulator.aircraft.servos import ServoRack
from up_simulator.aircraft.start import (
    MERIDIAN_M,
    PARALLEL_M,
    START_LATITUDE_DEG,
    START_LONGITUDE_DEG,
    Start,
    set_initial,
)
from up_simulator.aircraft.weather import Air, Weather

_Move = tuple[Callable[[float], None], int, float, float]
_NEWTON_LBS = 1 / 4.4482216
_INCH_M = 0.0254
_CHANNELS = {"ailerons": 0, "elevator": 1, "rudder": 3}
_READ = {
    "roll": "attitude/phi-rad",
    "pitch": "attitude/theta-rad",
    "yaw": "attitude/psi-rad",
    "p": "velocities/p-rad_sec",
    "q": "velocities/q-rad_sec",
    "r": "velocities/r-rad_sec",
    "p_dot": "accelerations/pdot-rad_sec2",
    "q_dot": "accelerations/qdot-rad_sec2",
    "r_dot": "accelerations/rdot-rad_sec2",
    "latitude": "position/lat-geod-deg",
    "longitude": "position/long-gc-deg",
    "altitude": "position/h-sl-ft",
    "height": "position/h-agl-ft",
    "north_speed": "velocities/v-north-fps",
    "east_speed": "velocities/v-east-fps",
    "down_speed": "velocities/v-down-fps",
    "airspeed": "velocities/vt-fps",
    "alpha": "aero/alpha-deg",
    "beta": "aero/beta-deg",
    "load": "accelerations/Nz",
    "wind_north": "atmosphere/total-wind-north-fps",
    "wind_east": "atmosphere/total-wind-east-fps",
    "wind_down": "atmosphere/total-wind-down-fps",
    "force_x": "accelerations/a-pilot-x-ft_sec2",
    "force_y": "accelerations/a-pilot-y-ft_sec2",
    "force_z": "accelerations/a-pilot-z-ft_sec2",
}


class FlightDynamics:
    """A flight in steps of 2 ms, launched in the air or thrown.

    The same arguments and the same pulses at the same steps fly the same flight to the last
    digit. ``crash`` is one sentence about the end of the flight; after it only the time advances.
    With ``may_land`` a soft contact with the ground is not a crash: the aircraft slides and stops.
    ``model`` is the flight model that flies. Raises ``FlightUnavailableError`` where it cannot.
    """

    STEP_S = 0.002

    def __init__(
        self,
        airframe: Airframe,
        start: Start | None = None,
        weather: Weather | None = None,
        seed: int = 1,
        *,
        may_land: bool = False,
        model: ModelChoice = "auto",
    ) -> None:
        self.airframe = airframe
        self.model = chosen_model(model)
        self.weather = weather or Weather()
        self.crash: str | None = None
        self.motor_works = True
        """Whether the motor gives thrust; it may change in flight, and nothing reports it."""
        self.is_thrown = False
        """Set to True it throws an aircraft that a hand holds."""
        self.is_landed = False
        self._may_land = may_land
        self._run: GroundRun | None = None
        self._seed = seed
        self._steps = 0
        self._owed_s = 0.0
        self._launches = 0
        self._state: FlightState | None = None
        self._motion: Motion | None = None
        self._read: dict[str, Callable[[], float]] = {}
        servos = airframe.servos
        self._servos = ServoRack(
            servos.slew_us_s,
            servos.lag_ms / 1000,
            self.STEP_S,
            servos.dead_band_us,
            servos.play_us,
        )
        self.launch(start or Start())

    @property
    def time_s(self) -> float:
        """Return how long it has flown, launches included."""
        return self._steps * self.STEP_S

    @property
    def state(self) -> FlightState:
        if self._state is None:
            self._state = self._read_state()
            if self._run is not None:
                self._state = replace(self._run.state, time_s=self.time_s, **self._drive())
        return self._state

    @property
    def motion(self) -> Motion:
        if self._motion is None:
            self._motion = self._feel() if self._run is None else self._run.motion
        return self._motion

    @property
    def a7_v(self) -> float:
        """Return the voltage that the flight battery's divider gives to the board's pin A7."""
        return self._battery.voltage_v * self.airframe.battery.divider

    @property
    def servos(self) -> Servos:
        return self._servos.rounded_us

    def set_servos(self, pulses_us: tuple[float, float, float, float]) -> None:
        """Command the servos to these pulses; they move at their own speed."""
        self._servos.set(pulses_us)

    def advance(self, duration_s: float) -> None:
        """Run all whole steps of 2 ms; the remainder is added to the next call."""
        self._owed_s += duration_s
        while self._owed_s >= self.STEP_S - 1e-9:
            self._owed_s -= self.STEP_S
            self.step()

    def step(self) -> None:
        self._steps += 1
        self._state = None
        if self.crash is not None:
            return
        servos = self._servos
        servos.step()
        positions_us = servos.positions_us
        for set_surface, channel, neutral_us, travel in self._moves:
            set_surface((positions_us[channel] - neutral_us) * travel)
        if self._motor is not None:
            throttle = (positions_us[2] - 1000.0) * 0.001 if self.motor_works else 0.0
            thrust_n = self._motor.step(
                0.0 if throttle < 0.0 else 1.0 if throttle > 1.0 else throttle,
                self._read_airspeed() * FOOT_M,
                self.STEP_S,
            )
            self._set_thrust(thrust_n * _NEWTON_LBS)
        else:
            self._battery.draw(0.0, self.STEP_S)
        self._air.apply(self._steps * self.STEP_S - self._launched_s)
        self._motion = None
        if self._run is not None:
            if self.is_landed or self.is_thrown:
                self._run.advance(self.STEP_S)
            if self.is_landed or not self._run.is_over:
                return
            self._run = None
        try:
            is_flying = self._fdm.run()
        except (RuntimeError, ArithmeticError, ValueError) as error:
            # JSBSim's exceptions: a property that no longer exists, a table without an answer; the
            # built-in model's: a number that is too large, a root of a negative one.
            self.crash = f"the flight model has given up: {error}"
            return
        if is_flying:
            self._watch()
        else:
            self.crash = "the flight model has given up"

    def change_battery(self) -> None:
        """Swap in a full battery in flight, which only the simulator can do."""
        self._battery.charge()

    def set_charge(self, percent: float) -> None:
        self._battery.charge(percent)

    def launch(self, start: Start) -> None:
        """Restart the flight in the air, with a full battery; the time continues."""
        airframe = self.airframe
        self.crash = None
        self._launched_s = self.time_s
        self._state = None
        self._motion = None
        # A NaN state survives new initial conditions: rebuild the model.
        self._fdm: FlightModel = load_model(airframe.model_path, self.STEP_S, self.model)
        seed = self._seed + self._launches
        set_initial(self._fdm, start, airframe.launch, self.weather, seed)
        self._read = {name: self._fdm.reader(node) for name, node in _READ.items()}
        self._read_airspeed = self._read["airspeed"]
        self._read_height, self._read_load = self._read["height"], self._read["load"]
        self._imu_m = self._imu_from_pilot()
        self._moves = list(self._find_moves())
        self._battery = Battery(airframe.battery)
        self._motor = Motor(airframe.motor, self._battery) if airframe.has_motor else None
        self._servos.jump((1500, 1500, 1000 + 1000 * start.throttle, 1500))
        if self._motor is not None:
            self._set_thrust = self._fdm.writer(MOTOR)
            self._motor.spin_up(start.throttle, self._read_airspeed() * FOOT_M)
            self._set_thrust(self._motor.thrust_n * _NEWTON_LBS)
        self._air = Air(self._fdm, self.weather)
        self.is_landed = False
        self._run = None
        if start.throw_m_s is not None:
            self._run = GroundRun.in_the_hand(self._read_state(), start.throw_m_s)
        self._launches += 1

    def _imu_from_pilot(self) -> tuple[float, float, float]:
        """Return where the IMU is from the model's pilot, whose acceleration it has; body, m."""
        fdm, imu = self._fdm, self.airframe.imu
        pilot = (
            (fdm[f"metrics/eyepoint-{axis}-in"] - fdm[f"inertia/cg-{axis}-in"]) * _INCH_M
            for axis in "xyz"
        )
        aft_m, right_m, up_m = pilot
        return imu.x_m + aft_m, imu.y_m - right_m, imu.z_m + up_m

    def _feel(self) -> Motion:
        read = self._read
        p, q, r = read["p"](), read["q"](), read["r"]()
        p_dot, q_dot, r_dot = read["p_dot"](), read["q_dot"](), read["r_dot"]()
        x, y, z = self._imu_m
        return Motion(
            math.degrees(p),
            math.degrees(q),
            math.degrees(r),
            read["force_x"]() * FOOT_M
            + q_dot * z - r_dot * y + p * (q * y + r * z) - x * (q * q + r * r),
            read["force_y"]() * FOOT_M
            + r_dot * x - p_dot * z + q * (p * x + r * z) - y * (p * p + r * r),
            read["force_z"]() * FOOT_M
            + p_dot * y - q_dot * x + r * (p * x + q * y) - z * (p * p + q * q),
        )  # fmt: skip

    def _find_moves(self) -> Iterator[_Move]:
        for name, channel in _CHANNELS.items():
            servo = getattr(self.airframe.servos, name)
            for node, travel in servo.moves.items():
                scaled = math.radians(travel) if node.endswith("-rad") else travel
                yield self._fdm.writer(node), channel, float(servo.neutral_us), scaled / 500

    def _watch(self) -> None:
        height_m, load_g = self._read_height() * FOOT_M, self._read_load()
        if height_m > 0.1 and abs(load_g) <= self.airframe.limits.break_g:
            return
        if height_m <= 0.1 and self._may_land and is_soft(self._read_state()):
            self.is_landed = True
            self._run = GroundRun.on_the_ground(self._read_state())
            return
        time_s = self.time_s - self._launched_s
        if not math.isfinite(height_m + load_g):
            self.crash = f"the flight model lost itself after {time_s:.2f} s"
        elif height_m <= 0.1:
            speed_m_s = self._read_airspeed() * FOOT_M
            down_m_s = self._read["down_speed"]() * FOOT_M
            self.crash = (
                f"hit the ground after {time_s:.2f} s, at {speed_m_s:.1f} m/s and sinking "
                f"{down_m_s:.1f} m/s"
            )
        else:
            self.crash = f"broke in the air after {time_s:.2f} s, at {load_g:.1f} g"

    def _read_state(self) -> FlightState:
        value = {name: read() for name, read in self._read.items()}
        north, east = value["north_speed"], value["east_speed"]
        return FlightState(
            time_s=self.time_s,
            roll_deg=math.degrees(value["roll"]),
            pitch_deg=math.degrees(value["pitch"]),
            yaw_deg=math.degrees(value["yaw"]) % 360.0,
            roll_rate_deg_s=math.degrees(value["p"]),
            pitch_rate_deg_s=math.degrees(value["q"]),
            yaw_rate_deg_s=math.degrees(value["r"]),
            latitude_deg=value["latitude"],
            longitude_deg=value["longitude"],
            altitude_m=value["altitude"] * FOOT_M,
            height_m=value["height"] * FOOT_M,
            speed_m_s=math.hypot(north, east) * FOOT_M,
            track_deg=math.degrees(math.atan2(east, north)) % 360.0,
            airspeed_m_s=value["airspeed"] * FOOT_M,
            alpha_deg=value["alpha"],
            sideslip_deg=value["beta"],
            load_factor_g=value["load"],
            climb_m_s=-value["down_speed"] * FOOT_M,
            north_m=math.radians(value["latitude"] - START_LATITUDE_DEG) * MERIDIAN_M,
            east_m=math.radians(value["longitude"] - START_LONGITUDE_DEG) * PARALLEL_M,
            **self._drive(),
            wind_north_m_s=value["wind_north"] * FOOT_M,
            wind_east_m_s=value["wind_east"] * FOOT_M,
            wind_down_m_s=value["wind_down"] * FOOT_M,
        )

    def _drive(self) -> dict[str, float]:
        motor, battery = self._motor, self._battery
        return {
            "battery_v": battery.voltage_v,
            "battery_percent": battery.percent,
            "motor_rpm": motor.rpm if motor else 0.0,
            "motor_w": motor.power_w if motor else 0.0,
        }
