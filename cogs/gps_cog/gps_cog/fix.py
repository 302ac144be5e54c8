"""A fix as a receiver reports it."""

import math

from up.commands.command import InvalidCommandError
from up.commands.location_command import LocationCommand
from up.quick_dataclass import dataclass

HDOP_M = 2.5
"""Accuracy of a fix with a dilution of 1, where the receiver does not estimate it."""


@dataclass(frozen=True, slots=True)
class GpsFix:
    """None stands for an unknown value; ``kind``: for a receiver without a fix.

    ``stamp_s`` is the time of the measurement by the receiver's clock, whose zero differs between
    the formats. The altitude is above the sea, the course over the ground, clockwise from north.
    """

    kind: str | None
    stamp_s: float | None = None
    latitude_deg: float = math.nan
    longitude_deg: float = math.nan
    altitude_m: float | None = None
    accuracy_m: float | None = None
    speed_m_s: float | None = None
    course_deg: float | None = None
    climb_m_s: float | None = None
    satellites: int | None = None
    pdop: float | None = None

    def command(self, age_s: float) -> LocationCommand | None:
        """Return the fix as a Command; None if a value is impossible."""
        if self.latitude_deg == self.longitude_deg == 0.0:
            # What a receiver without a position sends when it claims one.
            return None
        data = {
            "latitude": self.latitude_deg,
            "longitude": self.longitude_deg,
            "altitude": self.altitude_m,
            "accuracy": self.accuracy_m,
            "speed": self.speed_m_s,
            "bearing": self.course_deg,
            "climb": self.climb_m_s,
            "age_ms": round(age_s * 1000),
            "satellites": self.satellites,
            "fix": self.kind,
            "pdop": self.pdop,
        }
        try:
            return LocationCommand.from_data(data)
        except InvalidCommandError:
            return None
