"""Barometers: Bosch BMP280 (BST-BMP280-DS001) and BMP388 (BST-BMP388-DS001)."""

import struct

from sensors_cog.sensor import Aircraft, I2cSensor
from up.commands.altitude_command import AltitudeCommand

SEA_LEVEL_PA = 101325.0
SCALE_M, EXPONENT = 44330.77, 0.190263
"""The standard atmosphere (ISO 2533) below 11 km."""
SHIFTS = (-8, 30, 48, 20, 29, 32, 37, -3, 6, 8, 15, 48, 48, 65)
"""BMP388: powers of two by which par_T1 to par_T3 and par_P1 to par_P11 are divided."""
MIN_PA, MAX_PA = 30_000.0, 125_000.0
"""The range of both chips."""


def altitude(pressure_pa: float) -> AltitudeCommand | None:
    """Return the altitude by the standard atmosphere; its offset is the estimator's."""
    if not MIN_PA <= pressure_pa <= MAX_PA:
        return None
    return AltitudeCommand(SCALE_M * (1.0 - (pressure_pa / SEA_LEVEL_PA) ** EXPONENT))


class Bmp280(I2cSensor):
    """Pressure oversampled 16 times, filter coefficient 4: 26 measurements each second."""

    ADDRESS = 0x76

    def begin(self) -> None:
        self.expect(0xD0, 0x58)
        # dig_T1 to dig_T3, dig_P1 to dig_P9.
        self._t1, *self._t, self._p1 = struct.unpack("<HhhH", self.get(0x88, 8))
        self._p = struct.unpack("<8h", self.get(0x90, 16))
        self.put(0xF5, 0x08)
        self.put(0xF4, 0x57)

    def read(self, aircraft: Aircraft) -> AltitudeCommand | None:
        data = self.get(0xF7, 6)
        raw_p, raw_t = (int.from_bytes(data[at : at + 3]) >> 4 for at in (0, 3))
        if raw_p == 0x80000:
            # The value after a reset.
            return None
        return altitude(self.pressure_pa(raw_p, raw_t))

    def pressure_pa(self, raw_p: int, raw_t: int) -> float:
        """Compensate by section 8.1 of the data sheet."""
        (t2, t3), (p2, p3, p4, p5, p6, p7, p8, p9) = self._t, self._p
        off = raw_t / 131072.0 - self._t1 / 8192.0
        fine = (raw_t / 16384.0 - self._t1 / 1024.0) * t2 + off * off * t3
        var1 = fine / 2.0 - 64000.0
        var2 = (var1 * var1 * p6 / 32768.0 + var1 * p5 * 2.0) / 4.0 + p4 * 65536.0
        var1 = (1.0 + (p3 * var1 * var1 / 524288.0 + p2 * var1) / 524288.0 / 32768.0) * self._p1
        if var1 == 0.0:
            return 0.0
        pressure = (1048576.0 - raw_p - var2 / 4096.0) * 6250.0 / var1
        more = p9 * pressure * pressure / 2147483648.0 + pressure * p8 / 32768.0 + p7
        return float(pressure + more / 16.0)


class Bmp388(I2cSensor):
    """Also the BMP390: pressure oversampled 8 times, filter coefficient 3, 50 each second."""

    ADDRESS = 0x77

    def begin(self) -> None:
        self.expect(0x00, 0x50, 0x60)
        values = list(struct.unpack("<HHbhhbbHHbbhbb", self.get(0x31, 21)))
        values[3] -= 1 << 14
        values[4] -= 1 << 14
        self._c: list[float] = [each / 2.0**by for each, by in zip(values, SHIFTS, strict=True)]
        self.put(0x1C, 0x03)
        self.put(0x1D, 0x02)
        self.put(0x1F, 0x04)
        self.put(0x1B, 0x33)

    def read(self, aircraft: Aircraft) -> AltitudeCommand | None:
        if not self.get(0x03, 1)[0] & 0x20:
            return None
        data = self.get(0x04, 6)
        raw_p, raw_t = (int.from_bytes(data[at : at + 3], "little") for at in (0, 3))
        return altitude(self.pressure_pa(raw_p, raw_t))

    def pressure_pa(self, raw_p: int, raw_t: int) -> float:
        """Compensate by section 9 of the data sheet."""
        t1, t2, t3, p1, p2, p3, p4, p5, p6, p7, p8, p9, p10, p11 = self._c
        off = raw_t - t1
        t = off * t2 + off * off * t3
        offset = p5 + t * (p6 + t * (p7 + t * p8))
        slope = p1 + t * (p2 + t * (p3 + t * p4))
        return offset + raw_p * (slope + raw_p * (p9 + t * p10 + raw_p * p11))
