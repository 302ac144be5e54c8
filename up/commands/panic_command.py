"""Panic Mode: the load is too high, all senders reduce their rate (thesis 3.2.5)."""

from up.commands.command import BaseCommand, value
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class PanicCommand(BaseCommand):
    """Enters or leaves Panic Mode; ``delay_ms`` is the period that every sender shall keep."""

    NAME = "up.panic"
    ALIASES = ("load_guard.panic",)
    panic: bool = value()
    delay_ms: int = value(minimum=10, maximum=1000, unit="ms")
    utilization_percent: float | None = value(
        None, key="utilization", minimum=0, maximum=100, unit="percent"
    )
