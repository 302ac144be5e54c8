"""The system as a whole: its state, its links, its end."""

from up.commands.command import BaseCommand, value
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class SystemStateCommand(BaseCommand):
    """The state of the system (thesis 3.3.5), published once a second."""

    NAME = "up.system.state"
    utilization_percent: float = value(key="utilization", unit="percent")
    memory_percent: float = value(key="memory", unit="percent")
    providers: tuple[str, ...] = value()
    arduino_connected: bool = value()
    mode: str = value()


@dataclass(frozen=True, slots=True)
class SystemStopCommand(BaseCommand):
    """Stops the program; only modules of the program may send it."""

    NAME = "up.system.stop"


@dataclass(frozen=True, slots=True)
class LinkStateCommand(BaseCommand):
    """A link came or went: ``link`` is its name; its origin's role says what it links to."""

    NAME = "up.link.state"
    link: str = value(max_length=64)
    connected: bool = value()


@dataclass(frozen=True, slots=True)
class SourceSelectedCommand(BaseCommand):
    """A provider uses another source from now on; ``source`` is the name of its link."""

    NAME = "up.source.selected"
    reading: str = value(max_length=64)
    source: str = value(max_length=64)
