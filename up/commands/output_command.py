"""The servo positions that a flight controller on the Raspberry Pi computes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value


@dataclass(frozen=True, slots=True)
class OutputCommand(BaseCommand):
    """Four servo positions in microseconds, and the orientation frame they were computed from.

    Throttle 0 leaves it to the stick. The Arduino refuses an Output whose frame is too old.
    """

    NAME: ClassVar[str] = "up.output.set"
    NEEDS_CONTROL: ClassVar[bool] = True
    ailerons_us: int = value(key="ailerons", minimum=1000, maximum=2000, unit="us")
    elevator_us: int = value(key="elevator", minimum=1000, maximum=2000, unit="us")
    throttle_us: int = value(key="throttle", minimum=0, maximum=2000, unit="us")
    rudder_us: int = value(key="rudder", minimum=1000, maximum=2000, unit="us")
    sequence: int = value(minimum=0, maximum=65535)
