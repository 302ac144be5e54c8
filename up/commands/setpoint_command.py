"""An attitude that the Arduino holds for a limited time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from up.commands.command import BaseCommand, value


@dataclass(frozen=True, slots=True)
class SetpointCommand(BaseCommand):
    """An attitude asked of the Arduino; after ``lifetime_ms`` it holds level by itself."""

    NAME: ClassVar[str] = "up.setpoint.set"
    NEEDS_CONTROL: ClassVar[bool] = True
    roll_deg: float = value(key="roll", minimum=-90, maximum=90, unit="deg")
    pitch_deg: float = value(key="pitch", minimum=-90, maximum=90, unit="deg")
    yaw_rate_deg_s: float = value(0.0, key="yaw_rate", minimum=-300, maximum=300, unit="deg/s")
    throttle_us: int | None = value(None, key="throttle", minimum=1000, maximum=2000, unit="us")
    lifetime_ms: int = value(250, minimum=1, maximum=250, unit="ms")
