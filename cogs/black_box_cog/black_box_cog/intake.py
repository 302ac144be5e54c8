"""The program's side of the recorder: it only appends to a queue."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from black_box_cog.commands.record_command import RecordCommand
from up.commands.command import BaseCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line of the program's log; ``level`` as foxglove.Log counts."""

    level: int
    name: str
    message: str


@dataclass(frozen=True, slots=True)
class Recorded:
    """An object for a dedicated topic, encoded as JSON."""

    topic: str
    text: str


Entry = tuple[float, Any, Origin]
"""Monotonic time, a Command, LogLine or Recorded, and its origin."""
_OWN = Origin("log", Role.INTERNAL)


LIMIT_BYTES = 16_000_000
"""Approximate bound of the memory of waiting entries."""
_COMMAND_BYTES = 300
_FRAME_BYTES = 12_000
"""A frame of telemetry as a tree of Python's, about four times the size of its JSON."""


class Intake:
    """A queue from any thread to the recorder's; entries beyond its bounds are counted.

    ``limit`` bounds the entries, ``LIMIT_BYTES`` their memory, estimated by kind and text length.
    """

    def __init__(self, limit: int, now: Callable[[], float] = time.perf_counter) -> None:
        self.dropped = 0
        self._limit = limit
        self._now = now
        self._entries: deque[Entry] = deque()
        # Each is incremented by one thread only, or under the lock: no torn reads.
        self._observed_bytes = self._noted_bytes = self._taken_bytes = 0
        # A signal handler may log while its thread logs.
        self._noting = threading.RLock()

    def observe(self, command: BaseCommand, origin: Origin) -> None:
        """Take a Command from the bus, on the reactor's thread."""
        kind = type(command)
        if kind is RecordCommand:
            # If permitted, its content arrives separately, as Recorded.
            return
        size = _COMMAND_BYTES if kind is not TelemetryCommand else _FRAME_BYTES
        observed = self._observed_bytes + size
        if (
            len(self._entries) < self._limit
            and observed + self._noted_bytes - self._taken_bytes <= LIMIT_BYTES
        ):
            self._observed_bytes = observed
            self._entries.append((self._now(), command, origin))
        else:
            self.dropped += 1

    def note(self, subject: LogLine | Recorded, origin: Origin = _OWN) -> None:
        """Take any other entry, from any thread."""
        size = _size_of(subject)
        with self._noting:
            noted = self._noted_bytes + size
            if (
                len(self._entries) < self._limit
                and self._observed_bytes + noted - self._taken_bytes <= LIMIT_BYTES
            ):
                self._noted_bytes = noted
                self._entries.append((self._now(), subject, origin))
            else:
                self.dropped += 1

    def take(self, most: int) -> list[Entry]:
        """Return the oldest entries, for the recorder's thread."""
        entries = self._entries
        taken = [entries.popleft() for _ in range(min(len(entries), most))]
        self._taken_bytes += sum(_size_of(subject) for _, subject, _ in taken)
        return taken

    def __len__(self) -> int:
        """Return how many entries wait."""
        return len(self._entries)


def _size_of(subject: Any) -> int:
    kind = type(subject)
    if kind is LogLine:
        return _COMMAND_BYTES + len(subject.message)
    if kind is Recorded:
        return _COMMAND_BYTES + len(subject.text)
    return _FRAME_BYTES if kind is TelemetryCommand else _COMMAND_BYTES
