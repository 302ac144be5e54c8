"""The limits of bank and pitch in Fly By Wire."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value


@dataclass(frozen=True, slots=True)
class FlyByWireLimitsCommand(BaseCommand):
    """What the airframe's configuration says of the limits; None: it says nothing.

    Published whenever a board answers that may be another one, before it lets anybody fly.
    """

    NAME: ClassVar[str] = "up.flight.limits"
    roll_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
    pitch_up_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
    pitch_down_deg: float | None = value(None, minimum=0, maximum=90, unit="deg")
