"""What the rest of the program does for the recorder: appending to a queue, and no more."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from up.commands.command import BaseCommand
from up.commands.origin import Origin
from up.commands.roles import Role


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line of the program's log; ``level`` as foxglove.Log counts."""

    level: int
    name: str
    message: str


@dataclass(frozen=True, slots=True)
class Recorded:
    """What came for a topic of its own: an object, encoded as JSON."""

    topic: str
    text: str


Entry = tuple[float, Any, Origin]
"""Monotonic time, a Command, LogLine or Recorded, and its origin."""
_OWN = Origin("log", Role.INTERNAL)


class Intake:
    """A queue from any thread to the recorder's; what does not fit in is counted."""

    def __init__(self, limit: int, now: Callable[[], float] = time.perf_counter) -> None:
        self.dropped = 0
        self._limit = limit
        self._now = now
        self._entries: deque[Entry] = deque()

    def observe(self, command: BaseCommand, origin: Origin) -> None:
        """Take a Command from the bus."""
        if len(self._entries) < self._limit:
            self._entries.append((self._now(), command, origin))
        else:
            self.dropped += 1

    def note(self, subject: LogLine | Recorded, origin: Origin = _OWN) -> None:
        """Take anything else."""
        if len(self._entries) < self._limit:
            self._entries.append((self._now(), subject, origin))
        else:
            self.dropped += 1

    def take(self, most: int) -> list[Entry]:
        """Return the oldest entries, for the recorder's thread."""
        entries = self._entries
        return [entries.popleft() for _ in range(min(len(entries), most))]

    def __len__(self) -> int:
        """Return how many wait."""
        return len(self._entries)
