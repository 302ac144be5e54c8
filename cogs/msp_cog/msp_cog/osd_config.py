"""osd.yml: the text on the pilot's goggles."""

import re
from collections.abc import Iterator
from dataclasses import fields

from up.config import ConfigFile, key, section
from up.quick_dataclass import dataclass

WIDTHS = {
    "mode": 14,
    "time": 6,
    "altitude": 9,
    "speed": 9,
    "airspeed": 9,
    "home": 16,
    "battery": 9,
    "satellites": 7,
    "warnings": 26,
}
"""Columns of each element."""
BITS_OF_BYTE = 10
"""On the line, with start and stop bit."""
_PLACE = re.compile(r"(-?\d{1,2}),(-?\d{1,2})", re.ASCII)


def _place(default: str, about: str) -> str:
    made: str = key(default, about, max_length=8)
    return made


@dataclass(frozen=True, slots=True)
class ElementsConfig:
    """Where each element begins: column,row from the upper left, which is 0,0.

    Negative numbers count from the right and from the bottom: -1 is the last one. Empty: not shown.
    """

    mode: str = _place("1,1", "The flight mode; with a star: disarmed.")
    time: str = _place("-7,1", "Time since arming.")
    home: str = _place("1,2", "Distance to home, and the turn there: R045 is 45 degrees right.")
    speed: str = _place("1,6", "Speed over the ground.")
    airspeed: str = _place("1,7", "Airspeed.")
    altitude: str = _place("-10,6", "Height above home.")
    warnings: str = _place("2,-5", "Failsafes and alarms, one after the other.")
    battery: str = _place("1,-2", "Voltage of the flight battery.")
    satellites: str = _place("-8,-2", "Satellites of the position.")

    def problems(self) -> Iterator[tuple[str, str, str]]:
        for name in WIDTHS:
            text = getattr(self, name)
            if text and not _PLACE.fullmatch(text):
                yield name, f"{text!r} is not column,row, as 1,2 or -9,-2", "not_a_place"


@dataclass(frozen=True, slots=True)
class OsdConfig:
    """Goggles whose video transmitter draws text by MSP DisplayPort (HDZero, Walksnail, DJI).

    The transmitter is at a serial port of the Raspberry Pi. It only shows: nothing that it sends
    has an effect on the flight.
    """

    port: str = key(
        "", "Its serial port, as /dev/serial0. Empty: no goggles.", max_length=4096
    )  # fmt: skip
    baud_rate: int = key(115200, "Its speed.", unit="baud", minimum=19200, maximum=1000000)
    grid: str = key(
        "50x18",
        "Columns and rows of the goggles: 30x16 is that of SD, 50x18 of HDZero, 53x20 of Walksnail"
        " and DJI.",
        choices=("30x16", "50x18", "53x20"),
    )
    bytes_per_s: int = key(
        2000, "The most that is sent in a second.", minimum=1000, maximum=10000
    )  # fmt: skip
    elements: ElementsConfig = section(ElementsConfig)

    @property
    def size(self) -> tuple[int, int]:
        columns, rows = self.grid.split("x")
        return int(columns), int(rows)

    @property
    def places(self) -> dict[str, tuple[int, int]]:
        """Return column and row of each shown element, from the upper left."""
        columns, rows = self.size
        found = {}
        for each in fields(self.elements):
            match = _PLACE.fullmatch(getattr(self.elements, each.name))
            if match:
                column, row = map(int, match.groups())
                column += columns if column < 0 else 0
                found[each.name] = column, row + (rows if row < 0 else 0)
        return found

    def problems(self) -> Iterator[tuple[str, str, str]]:
        if self.bytes_per_s * BITS_OF_BYTE > self.baud_rate:
            what = f"a line of {self.baud_rate} baud carries {self.baud_rate // BITS_OF_BYTE}"
            yield "bytes_per_s", what, "too_fast"
        columns, rows = self.size
        taken: dict[tuple[int, int], str] = {}
        for name, (column, row) in self.places.items():
            width = WIDTHS[name]
            if not (0 <= column <= columns - width and 0 <= row < rows):
                what = f"{name}: {width} columns at {column},{row} do not fit into {self.grid}"
                yield "elements", what, "outside_grid"
                continue
            for at in range(column, column + width):
                other = taken.setdefault((at, row), name)
                if other != name:
                    yield "elements", f"{name} lies over {other}", "overlap"
                    break


OSD = ConfigFile("osd.yml", OsdConfig)
