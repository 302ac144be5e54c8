"""The program's side of the recorder: it only appends to a queue, and reads the status."""

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Any, cast

from twisted.logger import ILogObserver, LogEvent, LogLevel, globalLogPublisher
from zope.interface import implementer

from black_box_cog.commands.black_box_commands import RecordCommand
from up.commands.command import BaseCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand
from up.flight_log.foxglove import LOG_LEVELS
from up.log.json_lines import fields_of
from up.log.levels import level_of
from up.log.text import source_of, text_of
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line of the program's log; ``level`` as foxglove.Log counts.

    An event with a ``code`` has its fields too.
    """

    level: int
    name: str
    message: str
    code: str = ""
    fields: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RecorderStatus:
    """Whether a file is written, its name, the size of its flight, the losses, the problem."""

    recording: bool = False
    file: str | None = None
    megabytes: float = 0.0
    dropped: int = 0
    problem: str | None = None


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


class IngestQueue:
    """A queue from any thread to the recorder's; entries beyond its bounds are counted.

    ``limit`` bounds the entries, ``LIMIT_BYTES`` their memory, estimated by kind and text length.
    """

    def __init__(self, limit: int, now: Callable[[], float] = time.perf_counter) -> None:
        self.dropped = 0
        self._limit = limit
        self._now = now
        self._entries: deque[Entry] = deque()
        # Each is incremented by one thread only, or under the lock: no torn reads.
        self._observed_bytes = self._put_bytes = self._popped_bytes = 0
        # A signal handler may log while its thread logs.
        self._put_lock = threading.RLock()

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
            and observed + self._put_bytes - self._popped_bytes <= LIMIT_BYTES
        ):
            self._observed_bytes = observed
            self._entries.append((self._now(), command, origin))
        else:
            self.dropped += 1

    def put(self, subject: LogLine | Recorded, origin: Origin = _OWN) -> None:
        """Take any other entry, from any thread."""
        size = _size_of(subject)
        with self._put_lock:
            waiting = self._put_bytes + size
            if (
                len(self._entries) < self._limit
                and self._observed_bytes + waiting - self._popped_bytes <= LIMIT_BYTES
            ):
                self._put_bytes = waiting
                self._entries.append((self._now(), subject, origin))
            else:
                self.dropped += 1

    def pop(self, count: int) -> list[Entry]:
        """Return the oldest entries, for the recorder's thread."""
        entries = self._entries
        popped = [entries.popleft() for _ in range(min(len(entries), count))]
        self._popped_bytes += sum(_size_of(subject) for _, subject, _ in popped)
        return popped

    def __len__(self) -> int:
        return len(self._entries)


def _size_of(subject: Any) -> int:
    kind = type(subject)
    if kind is LogLine:
        return _COMMAND_BYTES + len(subject.message) + sum(map(_length, subject.fields.values()))
    if kind is Recorded:
        return _COMMAND_BYTES + len(subject.text)
    return _FRAME_BYTES if kind is TelemetryCommand else _COMMAND_BYTES


def _length(value: Any) -> int:
    return len(value) if isinstance(value, str) else 8


@implementer(ILogObserver)
class LogForwarder:
    """Forwards every event of level info and above, from any thread.

    It only forwards: the recorder's own events are recorded too, without recursion.
    """

    def __init__(self, put: Callable[[LogLine], object]) -> None:
        self._put = put

    def start(self) -> None:
        globalLogPublisher.addObserver(cast(ILogObserver, self))

    def stop(self) -> None:
        globalLogPublisher.removeObserver(cast(ILogObserver, self))

    def __call__(self, event: LogEvent) -> None:
        level = level_of(event)
        if level >= LogLevel.info:
            fields = fields_of(event) if "code" in event else {}
            code = str(fields.pop("code", ""))
            number = LOG_LEVELS.get(level.name, 0)
            self._put(LogLine(number, source_of(event), text_of(event), code, fields))
