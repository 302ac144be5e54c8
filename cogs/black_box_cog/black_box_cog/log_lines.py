"""Forwards the lines of the program's log to the flight log."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from twisted.logger import ILogObserver, LogEvent, LogLevel, globalLogPublisher
from zope.interface import implementer

from black_box_cog.intake import LogLine
from up.flight_log.foxglove import LOG_LEVELS
from up.log.levels import level_of
from up.log.text import source_of, text_of


@implementer(ILogObserver)
class LogLines:
    """Forwards every event of level info and above, from any thread.

    It only forwards: the recorder's own events are recorded too, without recursion.
    """

    def __init__(self, note: Callable[[LogLine], object]) -> None:
        self._note = note

    def start(self) -> None:
        """Start observing."""
        globalLogPublisher.addObserver(cast(ILogObserver, self))

    def stop(self) -> None:
        """Stop observing; harmless at any time."""
        globalLogPublisher.removeObserver(cast(ILogObserver, self))

    def __call__(self, event: LogEvent) -> None:
        """Forward one event, formatted immediately."""
        level = level_of(event)
        if level >= LogLevel.info:
            number = LOG_LEVELS.get(level.name, 0)
            self._note(LogLine(number, source_of(event), text_of(event)))
