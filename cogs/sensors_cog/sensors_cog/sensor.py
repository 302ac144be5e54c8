"""The base of the sensors at the I2C bus."""

from typing import Any, ClassVar

from smbus2 import i2c_msg

from sensors_cog.config import SensorConfig
from up.commands.command import BaseCommand
from up.quick_dataclass import dataclass


class WrongChipError(Exception):
    """Another chip answers at the address; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class Aircraft:
    """What a sensor may need of other readings; zero where it is unknown."""

    roll_deg: float = 0.0
    pitch_deg: float = 0.0
    altitude_m: float = 0.0


class I2cSensor:
    """A chip at an I2C bus: set ``ADDRESS``, override ``begin`` and ``read``.

    ``begin`` identifies and sets up the chip, after each time that it was absent; raises
    WrongChipError. ``read`` returns a Command with the measurement, or None without a new or a
    valid one. Both may block for some milliseconds, and raise OSError as the bus does.
    """

    ADDRESS: ClassVar[int] = 0
    PERIOD_S: ClassVar[float] = 0.1

    def __init__(self, bus: Any, config: SensorConfig) -> None:
        self.config = config
        self.address = self.ADDRESS if config.address is None else config.address
        self._bus = bus

    def begin(self) -> None:
        """Identify the chip and set it up."""

    def read(self, aircraft: Aircraft) -> BaseCommand | None:
        """Return a measurement."""
        raise NotImplementedError

    def expect(self, register: int, *values: int) -> None:
        """Raise WrongChipError unless a register has one of the values."""
        found = self.get(register, 1)[0]
        if found not in values:
            name = type(self).__name__
            raise WrongChipError(f"no {name} at address 0x{self.address:02x}: id 0x{found:02x}")

    def get(self, register: int, count: int) -> bytes:
        """Return bytes from a register on."""
        return bytes(self._bus.read_i2c_block_data(self.address, register, count))

    def put(self, register: int, *values: int) -> None:
        """Write bytes from a register on."""
        self._bus.write_i2c_block_data(self.address, register, list(values))

    def receive(self, count: int) -> bytes:
        """Return bytes of a chip without registers."""
        message = i2c_msg.read(self.address, count)
        self._bus.i2c_rdwr(message)
        return bytes(message)
