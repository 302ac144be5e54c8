"""sensors.yml: the sensors at the I2C bus."""

import re
from collections.abc import Iterator

from up.commands.origin import link_name_problem
from up.config import ConfigFile, key, mapping
from up.fields import Constraint
from up.quick_dataclass import dataclass

_CLASS = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)+", re.ASCII)
CHIPS = {
    "bmp280": "sensors_cog.chips.barometers.Bmp280",
    "bmp388": "sensors_cog.chips.barometers.Bmp388",
    "ms4525do": "sensors_cog.chips.airspeed.Ms4525do",
    "sdp3x": "sensors_cog.chips.airspeed.Sdp3x",
    "ina219": "sensors_cog.chips.power.Ina219",
    "ina226": "sensors_cog.chips.power.Ina226",
    "qmc5883l": "sensors_cog.chips.compasses.Qmc5883l",
    "ist8310": "sensors_cog.chips.compasses.Ist8310",
}


@dataclass(frozen=True, slots=True)
class SensorConfig:
    """One sensor."""

    chip: str = key(
        "bmp280",
        "bmp280, bmp388 (height); ms4525do, sdp3x (airspeed); ina219, ina226 (flight battery);"
        " qmc5883l, ist8310 (heading); or a class of your own, as my_sensors.lps22.Lps22.",
        max_length=200,
    )
    bus: int = key(1, "The I2C bus: 1 is /dev/i2c-1.", minimum=0, maximum=30)
    address: int | None = key(
        None, "Its address on the bus; null: the usual one.", minimum=3, maximum=119
    )
    priority: int = key(
        20,
        "Of several sensors of one kind the highest valid one is followed. The phone has 0.",
        minimum=-100,
        maximum=100,
    )
    offset_pa: float = key(
        0.0, "Airspeed: the pressure in still air.", unit="Pa", minimum=-500, maximum=500
    )
    shunt_mohm: float = key(
        100.0, "Flight battery: the shunt.", unit="mOhm", minimum=0.01, maximum=1000
    )
    rotation_deg: float = key(
        0.0, "Compass: how far the x axis is turned to the right of the nose.", unit="deg",
        minimum=-180, maximum=180,
    )  # fmt: skip
    declination_deg: float = key(
        0.0, "Compass: magnetic declination, east positive.", unit="deg", minimum=-180, maximum=180
    )
    offset_x_ut: float = key(0.0, "Compass: the aircraft's own field.", unit="uT")
    offset_y_ut: float = key(0.0, "Compass: the aircraft's own field.", unit="uT")
    offset_z_ut: float = key(0.0, "Compass: the aircraft's own field.", unit="uT")


@dataclass(frozen=True, slots=True)
class SensorsConfig:
    """Sensors at the I2C bus, by names of letters, digits and _: the source of their readings."""

    sensors: dict[str, SensorConfig] = mapping(
        Constraint(str, max_length=24), SensorConfig, "The sensors by name.", max_length=16
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        for name, sensor in self.sensors.items():
            if problem := link_name_problem(name):
                yield "sensors", problem
            if sensor.chip not in CHIPS and not _CLASS.fullmatch(sensor.chip):
                yield "sensors", f"{name}: chip must be one of {', '.join(CHIPS)}, or a class"


SENSORS = ConfigFile("sensors.yml", SensorsConfig)
