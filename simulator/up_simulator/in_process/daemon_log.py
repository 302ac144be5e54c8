"""A program's log, as lines with simulated time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import cast

from constantly import NamedConstant
from twisted.logger import ILogObserver, LogEvent, globalLogPublisher
from zope.interface import implementer

from up.log.levels import level_of, word_of
from up.log.text import source_of, text_of, traceback_of

LINES_MOST = 2000


@implementer(ILogObserver)
class DaemonLog:
    """Keeps the newest lines, between ``open`` and ``close``; no other observer is touched."""

    def __init__(self, seconds: Callable[[], float]) -> None:
        self.lines: deque[str] = deque(maxlen=LINES_MOST)
        self._seconds = seconds
        self._least: NamedConstant | None = None

    def open(self, least: NamedConstant) -> None:
        """Take every event of that level and above from now on."""
        if self._least is None:
            globalLogPublisher.addObserver(cast(ILogObserver, self))
        self._least = least

    def close(self) -> None:
        """Take no more events."""
        if self._least is not None:
            self._least = None
            globalLogPublisher.removeObserver(cast(ILogObserver, self))

    def say(self, text: str) -> None:
        """Add a line that is not an event."""
        self.lines.append(f"{self._seconds():9.3f} {text}")

    def __call__(self, event: LogEvent) -> None:
        """Keep an event that is severe enough."""
        least = self._least
        if least is not None and level_of(event) >= least:
            self.say(f"{word_of(level_of(event)):<8} {source_of(event)}: {text_of(event)}")
            self.lines.extend(f"    {line}" for line in traceback_of(event, least).splitlines())
