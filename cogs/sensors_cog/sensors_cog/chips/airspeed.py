"""Differential pressure: TE MS4525DO (001 psi, D, type A) and Sensirion SDP31, SDP32, SDP33."""

import math

from sensors_cog.sensor import Aircraft, I2cSensor, WrongChipError
from up.commands.airspeed_command import AirspeedCommand

SEA_LEVEL_KG_M3 = 1.225
LAPSE_PER_M, EXPONENT = 2.25577e-5, 4.2559
"""The density of the standard atmosphere (ISO 2533)."""
PSI_PA = 6894.757
MAX_PA = 1.1 * PSI_PA


def airspeed(sensor: I2cSensor, pressure_pa: float, aircraft: Aircraft) -> AirspeedCommand | None:
    """Return the true airspeed of a pitot tube in the density of the altitude."""
    if abs(pressure_pa) > MAX_PA:
        return None
    ram_pa = pressure_pa - sensor.config.offset_pa
    density = SEA_LEVEL_KG_M3 * max(0.3, 1.0 - LAPSE_PER_M * aircraft.altitude_m) ** EXPONENT
    speed_m_s = math.sqrt(2.0 * max(0.0, ram_pa) / density)
    return AirspeedCommand(speed_m_s, pressure_pa)


class Ms4525do(I2cSensor):
    """14 bits, 10 to 90 % of which are -1 to 1 psi (sections Output and Transfer function)."""

    ADDRESS = 0x28
    PERIOD_S = 0.05

    def read(self, aircraft: Aircraft) -> AirspeedCommand | None:
        data = self.receive(4)
        if data[0] >> 6:
            # A value that was read before, or a fault of the bridge.
            return None
        raw = int.from_bytes(data[:2]) & 0x3FFF
        return airspeed(self, (2.0 * (raw / 16383.0 - 0.1) / 0.8 - 1.0) * PSI_PA, aircraft)


class Sdp3x(I2cSensor):
    """Continuous measurement of differential pressure, averaged until it is read."""

    ADDRESS = 0x21
    PERIOD_S = 0.05
    PRODUCTS = (0x0301, 0x0302)

    def begin(self) -> None:
        # A running measurement refuses all but its end.
        self.put(0x3F, 0xF9)
        self.put(0x36, 0x7C)
        self.put(0xE1, 0x02)
        product = self._words(2)
        if product is None or product[0] not in self.PRODUCTS:
            raise WrongChipError(f"no Sdp3x at address 0x{self.address:02x}: product {product}")
        self.put(0x36, 0x15)

    def read(self, aircraft: Aircraft) -> AirspeedCommand | None:
        words = self._words(3)
        if words is None or not words[2]:
            return None
        pressure, _, scale = words
        return airspeed(self, (pressure - (pressure >> 15 << 16)) / scale, aircraft)

    def _words(self, count: int) -> list[int] | None:
        """Return words of 16 bits; None if a checksum is wrong."""
        data = self.receive(3 * count)
        parts = [data[at : at + 3] for at in range(0, 3 * count, 3)]
        if any(crc8(part[:2]) != part[2] for part in parts):
            return None
        return [int.from_bytes(part[:2]) for part in parts]


def crc8(data: bytes) -> int:
    """Return Sensirion's checksum: polynomial 0x31, initially 0xFF."""
    crc = 0xFF
    for each in data:
        crc ^= each
        for _ in range(8):
            crc = (crc << 1 ^ 0x31 if crc & 0x80 else crc << 1) & 0xFF
    return crc
