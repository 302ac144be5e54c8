"""Magnetometers: QST QMC5883L and iSentek IST8310. Axes x forward, y right, z down."""

import math
import struct

from sensors_cog.sensor import Aircraft, I2cSensor
from up.commands.heading_command import HeadingCommand

MIN_UT, MAX_UT = 10.0, 100.0
"""The earth's field is 22 to 67 uT: beside that, iron or current is too near."""


def heading(
    sensor: I2cSensor, field_ut: tuple[float, float, float], aircraft: Aircraft
) -> HeadingCommand | None:
    """Return the heading of the nose, levelled by the attitude."""
    config = sensor.config
    x = field_ut[0] - config.offset_x_ut
    y = field_ut[1] - config.offset_y_ut
    z = field_ut[2] - config.offset_z_ut
    if not MIN_UT <= math.sqrt(x * x + y * y + z * z) <= MAX_UT:
        return None
    # Into the axes of the aircraft, then level.
    turn = math.radians(config.rotation_deg)
    x, y = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
    roll, pitch = math.radians(aircraft.roll_deg), math.radians(aircraft.pitch_deg)
    right = y * math.cos(roll) - z * math.sin(roll)
    down = y * math.sin(roll) + z * math.cos(roll)
    forward = x * math.cos(pitch) + down * math.sin(pitch)
    heading_deg = math.degrees(math.atan2(-right, forward)) + config.declination_deg
    return HeadingCommand(heading_deg % 360.0, "actual")


class Qmc5883l(I2cSensor):
    """8 G, 512 samples, 50 measurements each second."""

    ADDRESS = 0x0D
    UT = 100.0 / 3000.0

    def begin(self) -> None:
        self.expect(0x0D, 0xFF)
        self.put(0x0B, 0x01)
        self.put(0x09, 0x15)

    def read(self, aircraft: Aircraft) -> HeadingCommand | None:
        data = self.get(0x00, 7)
        if data[6] & 0x03 != 0x01:
            # No new measurement, or one beyond the range.
            return None
        x, y, z = struct.unpack("<3h", data[:6])
        return heading(self, (x * self.UT, y * self.UT, z * self.UT), aircraft)


class Ist8310(I2cSensor):
    """One measurement of 16 samples at a time: each reading begins the next."""

    ADDRESS = 0x0E
    UT = 0.3

    def begin(self) -> None:
        self.expect(0x00, 0x10)
        self.put(0x41, 0x24)
        self.put(0x42, 0xC0)
        self.put(0x0A, 0x01)

    def read(self, aircraft: Aircraft) -> HeadingCommand | None:
        data = self.get(0x02, 7)
        self.put(0x0A, 0x01)
        if not data[0] & 0x01:
            return None
        x, y, z = struct.unpack("<3h", data[1:])
        return heading(self, (x * self.UT, y * self.UT, z * self.UT), aircraft)
