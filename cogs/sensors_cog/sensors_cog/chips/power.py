"""Voltage and current of the flight battery: TI INA219 (SBOS448) and INA226 (SBOS547)."""

from typing import ClassVar

from sensors_cog.sensor import Aircraft, I2cSensor, WrongChipError
from up.commands.flight_state_command import FlightBatteryCommand

CONFIGURATION, SHUNT, BUS = 0x00, 0x01, 0x02
RESET = 0x8000


class _PowerMonitor(I2cSensor):
    ADDRESS = 0x40
    PERIOD_S = 0.2
    IDENTITY: ClassVar[dict[int, int]] = {}
    """Registers and their values after a reset."""
    CONTINUOUS = 0
    """The configuration: the average of many measurements, again and again."""
    SHUNT_V, BUS_V, BUS_SHIFT = 0.0, 0.0, 0

    def begin(self) -> None:
        self.put(CONFIGURATION, *RESET.to_bytes(2))
        for register, value in self.IDENTITY.items():
            found = self._word(register)
            if found != value:
                name = type(self).__name__
                text = f"no {name} at address 0x{self.address:02x}: register {register} {found:#x}"
                raise WrongChipError(text)
        self.put(CONFIGURATION, *self.CONTINUOUS.to_bytes(2))

    def read(self, aircraft: Aircraft) -> FlightBatteryCommand | None:
        voltage_v = (self._word(BUS) >> self.BUS_SHIFT) * self.BUS_V
        shunt_v = int.from_bytes(self.get(SHUNT, 2), signed=True) * self.SHUNT_V
        return FlightBatteryCommand(voltage_v, shunt_v / self.config.shunt_mohm * 1000.0)

    def _word(self, register: int) -> int:
        return int.from_bytes(self.get(register, 2))


class Ina219(_PowerMonitor):
    """Up to 26 V; 320 mV at the shunt; the average of 128."""

    IDENTITY = {CONFIGURATION: 0x399F}
    CONTINUOUS = 0x3FFF
    SHUNT_V, BUS_V, BUS_SHIFT = 10e-6, 4e-3, 3


class Ina226(_PowerMonitor):
    """Up to 36 V; 81.92 mV at the shunt; the average of 64, 1.1 ms each."""

    IDENTITY = {0xFE: 0x5449, 0xFF: 0x2260}
    CONTINUOUS = 0x4727
    SHUNT_V, BUS_V, BUS_SHIFT = 2.5e-6, 1.25e-3, 0
