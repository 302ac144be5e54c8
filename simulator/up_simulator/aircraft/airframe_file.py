"""airframe.yml of a virtual aircraft: how its model is launched, moved, felt and driven."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from up.config import ConfigFile, key, mapping, section
from up.fields import Constraint
from up.flight_controller.airframe_profile import AirframeProfile
from up.flight_controller.pids_file import Rate, Stabilize
from up.flight_modes.navigation_file import Airspeed, Performance

_PROPERTY = Constraint(str, max_length=80)
_TRAVEL = Constraint(float, minimum=-90.0, maximum=90.0)


def _number(default: float, comment: str, unit: str, least: float, most: float) -> float:
    return key(default, comment, unit=unit, minimum=least, maximum=most)


@dataclass(frozen=True, slots=True)
class LaunchConfig:
    """How it flies when the flight begins and nothing else is asked: gliding, motor off."""

    airspeed_m_s: float = _number(11.0, "Cruise, through the air.", "m/s", 2, 120)
    pitch_deg: float = _number(-4.0, "Nose up positive.", "deg", -60, 60)
    alpha_deg: float = _number(1.0, "Angle of attack there.", "deg", -15, 25)
    level_throttle: float = _number(0.5, "Throttle that holds the height there.", "", 0, 1)


@dataclass(frozen=True, slots=True)
class ServoConfig:
    """What one output moves."""

    moves: dict[str, float] = mapping(
        _PROPERTY,
        _TRAVEL,
        "Properties of the model and where they go at 500 us above neutral: degrees for a property"
        " that ends in -rad, else its own unit.",
    )
    neutral_us: int = key(1500, "Pulse at which they are 0.", unit="us", minimum=1000, maximum=2000)


@dataclass(frozen=True, slots=True)
class ServosConfig:
    """The servos, by the output of the Arduino that they are plugged into."""

    slew_us_s: float = _number(6000.0, "Fastest move.", "us/s", 100, 100000)
    lag_ms: float = _number(15.0, "Time constant near the pulse.", "ms", 0, 500)
    dead_band_us: float = _number(3.0, "They rest while the pulse is so near.", "us", 0, 100)
    play_us: float = _number(8.0, "Play between servo and surface.", "us", 0, 200)
    ailerons: ServoConfig = section(ServoConfig, "Output D9; with mix: elevon an elevon.")
    elevator: ServoConfig = section(ServoConfig, "Output D10; with mix: elevon the other one.")
    rudder: ServoConfig = section(ServoConfig, "Output D11.")


@dataclass(frozen=True, slots=True)
class MotorConfig:
    """Motor and propeller; a diameter of 0 means no motor."""

    kv_rpm_v: float = _number(1000.0, "Turns in a minute by a volt.", "rpm/V", 10, 20000)
    resistance_ohm: float = _number(0.09, "Motor and speed controller.", "ohm", 0.001, 10)
    free_current_a: float = _number(0.8, "Without load.", "A", 0, 50)
    inertia_kg_m2: float = key(5e-5, "Propeller and bell.", unit="kg m2", minimum=1e-7, maximum=1.0)
    diameter_m: float = _number(0.0, "Of the propeller.", "m", 0, 3)
    thrust: float = _number(0.1, "Static thrust coefficient, of n^2 d^4.", "", 0, 0.5)
    power: float = _number(0.045, "Static power coefficient, of n^3 d^5.", "", 0.001, 0.5)
    pitch_j: float = _number(0.75, "Advance ratio without thrust.", "", 0.1, 3)


FULL_CELL_V, PIN_V = 4.2, 1.1


@dataclass(frozen=True, slots=True)
class BatteryConfig:
    """The flight battery, a LiPo."""

    cells: int = key(3, "In series.", minimum=1, maximum=14)
    capacity_mah: float = _number(2200.0, "When full.", "mAh", 50, 100000)
    resistance_ohm: float = _number(0.03, "Of all cells and wires.", "ohm", 0.001, 5)
    idle_a: float = _number(0.2, "What everything but the motor draws.", "A", 0, 20)
    charge_percent: float = _number(100.0, "When the flight begins.", "percent", 0, 100)
    divider: float = _number(
        0.0, "Volts at the board's pin A7 by volts of the battery; 0: not wired.", "", 0, 1
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.divider * self.cells * FULL_CELL_V > PIN_V:
            yield "divider", f"gives the pin more than {PIN_V:g} V with a full battery"


@dataclass(frozen=True, slots=True)
class ImuConfig:
    """Where the IMU sits and what shakes it."""

    x_m: float = _number(0.0, "Ahead of the centre of gravity.", "m", -5, 5)
    y_m: float = _number(0.0, "To the right of it.", "m", -5, 5)
    z_m: float = _number(0.0, "Below it.", "m", -5, 5)
    vibration_m_s2: float = _number(
        1.0, "Shaking at full throttle, standard deviation.", "m/s2", 0, 100
    )
    vibration_deg_s: float = _number(
        0.5, "Shaking at full throttle, standard deviation.", "deg/s", 0, 500
    )


@dataclass(frozen=True, slots=True)
class LimitsConfig:
    """What the airframe bears."""

    load_g: float = _number(6.0, "Load factor that must not be exceeded.", "g", 1, 50)
    break_g: float = _number(10.0, "Load factor at which it breaks.", "g", 1, 100)

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.break_g < self.load_g:
            yield "break_g", f"must not be below load_g, which is {self.load_g:g}"


@dataclass(frozen=True, slots=True)
class GainsConfig:
    """The gains that it flies with, as in pids.yml."""

    rate: Rate = section(Rate)
    stabilize: Stabilize = section(Stabilize)


@dataclass(frozen=True, slots=True)
class AirframeNavigation:
    """Its airspeeds and performance, as in navigation.yml."""

    airspeed: Airspeed = section(Airspeed)
    performance: Performance = section(Performance)


@dataclass(frozen=True, slots=True)
class AirframeFile:
    """A virtual aircraft. The model is JSBSim's; profile and gains are the Arduino's."""

    title: str = key("", "A few words.", max_length=80)
    about: str = key("", "Some sentences.", max_length=1000)
    model: str = key(
        "",
        "The JSBSim model, a file beside this one; without it geometry.yml gives the model.",
        max_length=200,
    )
    launch: LaunchConfig = section(LaunchConfig)
    servos: ServosConfig = section(ServosConfig)
    motor: MotorConfig = section(MotorConfig)
    battery: BatteryConfig = section(BatteryConfig)
    imu: ImuConfig = section(ImuConfig)
    limits: LimitsConfig = section(LimitsConfig)
    profile: AirframeProfile = section(
        AirframeProfile, "Profile of the Arduino, as in config/airframe.yml."
    )
    gains: GainsConfig = section(GainsConfig)
    navigation: AirframeNavigation = section(AirframeNavigation)

    def problems(self) -> Iterator[tuple[str, str]]:
        if not self.title:
            yield "title", "must be given"
        if self.model and ("/" in self.model or not self.model.endswith(".xml")):
            yield "model", "must be the name of an .xml file in the same folder"


FILENAME = "airframe.yml"


def file_named(name: str) -> ConfigFile[Any]:
    """Return the declaration of a file of this kind that may have another name."""
    ignored = {"gains.stabilize.rudder": "no controller holds a yaw angle"}
    return ConfigFile(name, AirframeFile, ignored=ignored)
