"""Telemetry and its period."""

from typing import Any

from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up.quick_dataclass import dataclass

MIN_PERIOD_MS = 20
MAX_PERIOD_MS = 10_000


@dataclass(frozen=True, slots=True)
class TelemetryCommand(BaseCommand):
    """One frame of telemetry (thesis 4.1.5) and its beacon number."""

    NAME = "up.telemetry.update"
    content: dict[str, Any] = value()
    beacon: int = value(minimum=0)

    @property
    def data(self) -> dict[str, Any]:
        """Return the merged content; the beacon travels beside it, at the message's top level."""
        return self.content


@dataclass(frozen=True, slots=True)
class TelemetryFrequencyCommand(BaseCommand):
    """The period of telemetry that the ground wants; the prototype called it a frequency."""

    NAME = "up.telemetry.frequency"
    TITLE = "Telemetry period {} ms"
    ROLES = frozenset({Role.OPERATOR})
    period_ms: float = value(
        key="frequency", minimum=MIN_PERIOD_MS, maximum=MAX_PERIOD_MS, unit="ms"
    )
