"""The environment of a scenario's flight: radio, IMU and link."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from up.config import items, key, section
from up.fields import Constraint
from up_rig.imu import NOISE_DEG_S, NOISE_M_S2
from up_simulator.aircraft.airframe_file import ImuConfig
from up_simulator.firmware.imu_errors import ZERO, ImuErrors, drawn_errors
from up_simulator.link.model import LinkSettings

_RATE = Constraint(float, minimum=-500, maximum=500, unit="deg/s")
_FORCE = Constraint(float, minimum=-50, maximum=50, unit="m/s^2")


@dataclass(frozen=True, slots=True)
class ReceiverPart:
    """The radio link between the pilot's sticks and the board's inputs."""

    delay_ms: float = key(
        20.0, "Delay from the stick to the pulses.", unit="ms", minimum=0, maximum=1000
    )
    failsafe_throttle_us: float = key(
        890.0,
        "Throttle that it sends without radio reception.",
        unit="us",
        minimum=800,
        maximum=2200,
    )


@dataclass(frozen=True, slots=True)
class ImuPart:
    """Errors of a working IMU: noise, bias, warm-up, vibration."""

    gyro_noise_deg_s: float = key(
        NOISE_DEG_S, "Standard deviation of each sample.", unit="deg/s", minimum=0, maximum=100
    )
    accel_noise_m_s2: float = key(
        NOISE_M_S2, "Standard deviation of each sample.", unit="m/s^2", minimum=0, maximum=50
    )
    gyro_bias_deg_s: tuple[float, ...] = items(
        _RATE,
        "Constant error of the rates: roll, pitch, yaw. Empty: 2 to 4 deg/s each, drawn by the"
        " seed.",
        max_length=3,
    )
    accel_bias_m_s2: tuple[float, ...] = items(
        _FORCE, "Constant error of the forces: x, y, z.", default=ZERO, max_length=3
    )
    gyro_drift_deg_s: tuple[float, ...] = items(
        _RATE,
        "Change of the bias until the IMU is warm. Empty: up to 1 deg/s each, drawn by the seed.",
        max_length=3,
    )
    warm_up_s: float = key(
        600.0, "Time constant of the warm-up, from power-on.", unit="s", minimum=0.1, maximum=3600
    )
    vibration_deg_s: float | None = key(
        None,
        "Amplitude in the rates at full throttle, proportional to the square of the throttle. null:"
        " that of the airframe.",
        unit="deg/s",
        minimum=0,
        maximum=500,
    )
    vibration_m_s2: float | None = key(
        None,
        "Amplitude in the forces at full throttle. null: that of the airframe.",
        unit="m/s^2",
        minimum=0,
        maximum=100,
    )
    vibration_hz: float = key(
        150.0, "Frequency at full throttle.", unit="Hz", minimum=1, maximum=1000
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        for name in ("gyro_bias_deg_s", "accel_bias_m_s2", "gyro_drift_deg_s"):
            if getattr(self, name) and len(getattr(self, name)) != 3:
                yield name, "must have three numbers, one for each axis"

    def errors(self, imu: ImuConfig, seed: int) -> ImuErrors:
        """Return the errors of the board's IMU in this airframe, in a flight with this seed."""
        values = {name: getattr(self, name) for name in self.__slots__}
        for name in ("vibration_deg_s", "vibration_m_s2"):
            if values[name] is None:
                values[name] = getattr(imu, name)
        return drawn_errors(seed, **{name: each for name, each in values.items() if each != ()})


@dataclass(frozen=True, slots=True)
class LinkPart:
    """The link between aircraft and ground, such as a cellular network."""

    up: LinkSettings = section(LinkSettings, "From the aircraft to the ground.")
    down: LinkSettings = section(LinkSettings, "From the ground to the aircraft.")
