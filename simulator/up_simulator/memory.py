"""What the board remembers: gains and the profile of the airframe, in RAM only."""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass

GREATEST_GAIN = 50.0
MOTOR_OFFSET = 29
SWITCH_LETTERS = frozenset("arfA")
PROFILE = struct.Struct(">" + "BhHH" * 4 + "BB" + "3s" + "hhh" + "hh" + "HH" + "HHH" + "B")
GAINS = (
    2.0, 0.0, 0.0, 1.5, 0.0, 0.0, 1.0, 0.0, 0.0,
    8.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 0.0, 0.0,
)  # fmt: skip
"""For an aircraft that nobody has tuned, as in the firmware and in pids.yml."""


class OutOfRangeError(Exception):
    """A set of values is refused whole."""


class Gains:
    """Eighteen gains in the order of ``g``: rate, then stabilize, P I D of three axes each."""

    def __init__(self) -> None:
        self._values = list(GAINS)

    @property
    def three_axes(self) -> bytes:
        """Return the 72 bytes of ``G``."""
        return struct.pack(">18f", *self._values)

    @property
    def two_axes(self) -> bytes:
        """Return the 48 bytes of ``T``: ailerons and elevator of both loops."""
        return struct.pack(">12f", *self._values[0:6], *self._values[9:15])

    def set_three_axes(self, payload: bytes) -> None:
        """Take the 72 bytes of ``g``; raises ``OutOfRangeError``."""
        self._values = list(_in_range(struct.unpack(">18f", payload)))

    def set_two_axes(self, payload: bytes) -> None:
        """Take the 48 bytes of ``t``, the rudder keeps its own; raises ``OutOfRangeError``."""
        values = _in_range(struct.unpack(">12f", payload))
        self._values[0:6] = values[:6]
        self._values[9:15] = values[6:]


def _in_range(values: tuple[float, ...]) -> tuple[float, ...]:
    if not all(math.isfinite(each) and 0.0 <= each <= GREATEST_GAIN for each in values):
        raise OutOfRangeError
    return values


@dataclass(frozen=True, slots=True)
class Profile:
    """The part of a profile (protocols 2.6) that the stand-in acts on, and its 54 bytes."""

    wire: bytes
    has_motor: bool
    switch: str
    throttle_failsafe_us: int
    throttle_lost_us: int
    preset_us: tuple[int, int, int]


def default_profile(has_motor: bool) -> Profile:
    """Return the profile that the board boots with: ACRO, FBW and AUTO on the switch."""
    channel = (0, 0, 1000, 2000)
    limits = (5000, 2000, 2500, -300, 2000)
    ends = (1000, 900, 1500, 1500, 1500, 0)
    wire = PROFILE.pack(*channel * 4, 0, int(has_motor), b"afA", *limits, *ends)
    return read_profile(wire)


def read_profile(wire: bytes) -> Profile:
    """Return the profile of 54 bytes; raises ``OutOfRangeError``."""
    fields = PROFILE.unpack(wire)
    for flags, trim_us, lowest_us, highest_us in (fields[at : at + 4] for at in (0, 4, 8, 12)):
        _require(flags <= 1 and abs(trim_us) <= 200)
        _require(800 <= lowest_us < highest_us <= 2200)
    mix, motor, letters, *angles_cdeg = fields[16:24]
    failsafe_us, lost_us, *preset_us = fields[24:29]
    switch = letters.decode("latin-1")
    _require(mix <= 2 and motor <= 1 and set(switch) <= SWITCH_LETTERS)
    _require(all(0 <= each <= 9000 for each in angles_cdeg[:3]))
    _require(all(abs(each) <= 9000 for each in angles_cdeg[3:]))
    _require(all(800 <= each <= 2200 for each in (failsafe_us, *preset_us)) and lost_us <= 2200)
    _require(fields[29] <= 1)
    ailerons_us, elevator_us, rudder_us = preset_us
    preset = (ailerons_us, elevator_us, rudder_us)
    return Profile(wire, bool(motor), switch, failsafe_us, lost_us, preset)


def _require(is_right: bool) -> None:
    if not is_right:
        raise OutOfRangeError
