"""Twins of the chips of the sensors cog, by their data sheets."""

from __future__ import annotations

import errno
import math
import struct
from collections.abc import Callable, Iterable

from up_simulator.aircraft.flight import FlightState
from up_simulator.sensors.twin import RegisterChip, TwinBus

SEA_LEVEL_PA, SEA_LEVEL_KG_M3, PSI_PA = 101325.0, 1.225, 6894.757
PRESSURE_NOISE_PA, AIR_NOISE_PA, FIELD_NOISE_UT = 2.0, 1.5, 0.3
FIELD_UT, INCLINATION_DEG = 48.0, 65.0
TEMPERATURE_C = 25.0


def pressure_pa(altitude_m: float) -> float:
    """Return the pressure of the standard atmosphere (ISO 2533) below 11 km."""
    return SEA_LEVEL_PA * math.pow(1.0 - 0.0065 * altitude_m / 288.15, 5.25588)


def _ram_pa(state: FlightState) -> float:
    density = SEA_LEVEL_KG_M3 * math.pow(1.0 - 0.0065 * state.altitude_m / 288.15, 4.25588)
    return 0.5 * density * state.airspeed_m_s**2


def _field_ut(state: FlightState) -> tuple[float, float, float]:
    """Return the earth's field along nose, right wing and down."""
    roll, pitch, yaw = (math.radians(x) for x in (state.roll_deg, state.pitch_deg, state.yaw_deg))
    horizontal = FIELD_UT * math.cos(math.radians(INCLINATION_DEG))
    down = FIELD_UT * math.sin(math.radians(INCLINATION_DEG))
    ahead, right = horizontal * math.cos(yaw), -horizontal * math.sin(yaw)
    x = ahead * math.cos(pitch) - down * math.sin(pitch)
    z = ahead * math.sin(pitch) + down * math.cos(pitch)
    y = right * math.cos(roll) + z * math.sin(roll)
    return x, y, z * math.cos(roll) - right * math.sin(roll)


def _raw(wanted: float, of: Callable[[int], float], bits: int) -> int:
    """Return the raw value whose compensated one is the wanted one, by bisection."""
    low, high = 0, 1 << bits
    is_rising = of(high) > of(low)
    while high - low > 1:
        middle = (low + high) // 2
        if (of(middle) > wanted) == is_rising:
            high = middle
        else:
            low = middle
    return low


class Bmp280(RegisterChip):
    """Its calibration is the example of the data sheet (3.12), its arithmetic that of 8.2."""

    T = 27504, 26435, -1000
    P = 36477, -10685, 3024, 2855, 140, -7, 15500, -14600, 6000
    RAW_T = 519888

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self.put(0xD0, [0x58])
        self.put(0x88, struct.pack("<Hhh", *self.T) + struct.pack("<H8h", *self.P))
        self.put(0xF7, [0x80, 0, 0, 0x80, 0, 0])

    def update(self, state: FlightState) -> None:
        if self.registers[0xF4] & 3 != 3:
            return
        wanted = pressure_pa(state.altitude_m) + self.noise.gauss(0.0, PRESSURE_NOISE_PA)
        raw = _raw(wanted, lambda each: self.compensated_pa(each, self.RAW_T), 20)
        self.put(0xF7, (raw << 4).to_bytes(3) + (self.RAW_T << 4).to_bytes(3))

    def compensated_pa(self, raw_p: int, raw_t: int) -> float:
        """Return the pressure by the data sheet's arithmetic of 64 bits."""
        t1, t2, t3 = self.T
        p1, p2, p3, p4, p5, p6, p7, p8, p9 = self.P
        fine = ((raw_t >> 3) - (t1 << 1)) * t2 >> 11
        fine += ((raw_t >> 4) - t1) ** 2 * t3 >> 26
        var1 = fine - 128000
        var2 = var1 * var1 * p6 + (var1 * p5 << 17) + (p4 << 35)
        var1 = (var1 * var1 * p3 >> 8) + (var1 * p2 << 12)
        var1 = ((1 << 47) + var1) * p1 >> 33
        p = (((1048576 - raw_p) << 31) - var2) * 3125 // var1
        p = (p + (p9 * (p >> 13) ** 2 >> 25) + (p8 * p >> 19) >> 8) + (p7 << 4)
        return p / 256.0


class Bmp388(RegisterChip):
    """The calibration is of one chip; the arithmetic that of the data sheet, section 9.3."""

    C = 27772, 18894, -7, 1234, -1213, 23, 1, 25015, 30256, -13, -4, 3971, 17, -60
    RAW_T = 8_387_000

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self.put(0x00, [0x50])
        self.put(0x31, struct.pack("<HHbhhbbHHbbhbb", *self.C))

    def update(self, state: FlightState) -> None:
        if self.registers[0x1B] != 0x33:
            return
        wanted = pressure_pa(state.altitude_m) + self.noise.gauss(0.0, PRESSURE_NOISE_PA)
        raw = _raw(wanted, lambda each: self.compensated_pa(each, self.RAW_T), 24)
        self.put(0x03, [0x60, *raw.to_bytes(3, "little"), *self.RAW_T.to_bytes(3, "little")])

    def compensated_pa(self, raw_p: int, raw_t: int) -> float:
        """Return the pressure by the partial sums of the data sheet."""
        c = self.C
        first = raw_t - c[0] * 2.0**8
        t = first * (c[1] / 2.0**30) + first**2 * (c[2] / 2.0**48)
        out1 = c[7] * 2.0**3 + c[8] / 2.0**6 * t + c[9] / 2.0**8 * t**2 + c[10] / 2.0**15 * t**3
        out2 = (c[3] - 2**14) / 2.0**20 + (c[4] - 2**14) / 2.0**29 * t
        out2 = raw_p * (out2 + c[5] / 2.0**32 * t**2 + c[6] / 2.0**37 * t**3)
        square = raw_p**2 * (c[11] / 2.0**48 + c[12] / 2.0**48 * t)
        return out1 + out2 + square + raw_p**3 * (c[13] / 2.0**65)


class Ms4525do(RegisterChip):
    """001 psi, differential, type A: a count of 14 bits, a temperature of 11."""

    def update(self, state: FlightState) -> None:
        psi = (_ram_pa(state) + self.noise.gauss(0.0, AIR_NOISE_PA)) / PSI_PA
        count = round(16383 * (0.1 + 0.8 * (psi + 1.0) / 2.0))
        warmth = round((TEMPERATURE_C + 50.0) * 2047 / 200.0)
        self.registers[:4] = count.to_bytes(2) + (warmth << 5).to_bytes(2)

    def read(self, count: int) -> bytes:
        data = bytes(self.registers[:count])
        # Read again before the next measurement it is stale.
        self.registers[0] = self.registers[0] & 0x3F | 0x80
        return data


class Sdp3x(RegisterChip):
    """An SDP31: 60 counts per Pa; a running measurement takes no command but its end."""

    PRODUCT = 0x0301, 0x0101
    SCALE = 60

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self._command = b""
        self._words: list[int] | None = None

    def write(self, data: bytes) -> None:
        if self._command == b"\x36\x15" and data != b"\x3f\xf9":
            raise OSError(errno.EREMOTEIO, "Remote I/O error")
        is_identifier = (self._command, data) == (b"\x36\x7c", b"\xe1\x02")
        self._words = list(self.PRODUCT) if is_identifier else None
        self._command = data

    def read(self, count: int) -> bytes:
        if self._words is None:
            raise OSError(errno.EREMOTEIO, "Remote I/O error")
        parts = [word.to_bytes(2) for word in self._words]
        return b"".join(part + bytes([_crc(part)]) for part in parts)[:count]

    def update(self, state: FlightState) -> None:
        if self._command == b"\x36\x15":
            pressure = _ram_pa(state) + self.noise.gauss(0.0, AIR_NOISE_PA / 5)
            count = max(-32768, min(32767, round(pressure * self.SCALE)))
            self._words = [count & 0xFFFF, round(TEMPERATURE_C * 200), self.SCALE]


def _crc(word: bytes) -> int:
    """Return the remainder of the division by x^8 + x^5 + x^4 + 1, begun with ones."""
    value = (int.from_bytes(word) ^ 0xFF00) << 8
    for bit in range(23, 7, -1):
        if value >> bit & 1:
            value ^= 0x131 << bit - 8
    return value


class Ina226(RegisterChip):
    """Words of 16 bits; each register is one word."""

    IDENTITY = {0x00: 0x4127, 0xFE: 0x5449, 0xFF: 0x2260}
    SHUNT_V, BUS_V, BUS_SHIFT = 2.5e-6, 1.25e-3, 0
    SHUNT_OHM = 0.1 / 100

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self.words = dict(self.IDENTITY)
        self._register = 0

    def write(self, data: bytes) -> None:
        self._register = data[0]
        if len(data) == 3:
            value = int.from_bytes(data[1:])
            self.words[data[0]] = self.IDENTITY[0] if value & 0x8000 else value

    def read(self, count: int) -> bytes:
        return self.words.get(self._register, 0).to_bytes(2)[:count]

    def update(self, state: FlightState) -> None:
        voltage_v = state.battery_v
        current_a = state.motor_w / voltage_v if voltage_v else 0.0
        self.words[0x02] = round(voltage_v / self.BUS_V) << self.BUS_SHIFT
        self.words[0x01] = round(current_a * self.SHUNT_OHM / self.SHUNT_V) & 0xFFFF


class Ina219(Ina226):
    """The bus voltage stands three bits higher."""

    IDENTITY = {0x00: 0x399F}
    SHUNT_V, BUS_V, BUS_SHIFT = 10e-6, 4e-3, 3


class Qmc5883l(RegisterChip):
    """3000 counts per gauss at 8 G."""

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self.put(0x0D, [0xFF])

    def update(self, state: FlightState) -> None:
        if self.registers[0x09] & 3 == 1:
            field = (x + self.noise.gauss(0.0, FIELD_NOISE_UT) for x in _field_ut(state))
            counts = (round(x * 30) for x in field)
            self.put(0x00, struct.pack("<3h", *counts) + b"\x01")

    def on_read(self, register: int) -> int:
        value = self.registers[register]
        if register == 0x06:
            # Reading the data ends DRDY.
            self.registers[register] = 0
        return value


class Ist8310(RegisterChip):
    """0.3 uT per count; a measurement for each request."""

    def __init__(self, seed: int = 1) -> None:
        super().__init__(seed)
        self.put(0x00, [0x10])

    def update(self, state: FlightState) -> None:
        if self.registers[0x0A] == 1:
            self.registers[0x0A] = 0
            field = (x + self.noise.gauss(0.0, FIELD_NOISE_UT) for x in _field_ut(state))
            counts = (round(x / 0.3) for x in field)
            self.put(0x02, b"\x01" + struct.pack("<3h", *counts))

    def on_write(self, register: int, value: int) -> None:
        self.registers[register] = value
        if register == 0x0A:
            self.registers[0x02] = 0


CHIPS: dict[str, tuple[int, type[RegisterChip]]] = {
    "bmp280": (0x76, Bmp280),
    "bmp388": (0x77, Bmp388),
    "ms4525do": (0x28, Ms4525do),
    "sdp3x": (0x21, Sdp3x),
    "ina219": (0x40, Ina219),
    "ina226": (0x40, Ina226),
    "qmc5883l": (0x0D, Qmc5883l),
    "ist8310": (0x0E, Ist8310),
}
"""The chips by the names of sensors.yml, with their usual addresses."""


def bus_of(names: Iterable[str], seed: int) -> TwinBus:
    """Return a bus with these chips at their usual addresses."""
    return TwinBus({address: cls(seed) for address, cls in map(CHIPS.__getitem__, names)})
