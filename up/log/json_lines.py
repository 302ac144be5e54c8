"""Events as JSON lines in a file that rotates."""

import contextlib
import errno
import json
import math
import os
import threading
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from constantly import NamedConstant
from twisted.logger import ILogObserver, LogEvent
from zope.interface import implementer

from up.log.levels import level_of, word_of
from up.log.text import source_of, text_of, traceback_of

_MAX_FIELD = 1000
_FLAGS = os.O_RDWR | os.O_APPEND | os.O_NONBLOCK | os.O_CLOEXEC


class RotatingFile:
    """An append-only file; at `rotate_bytes` it becomes `<name>.1` and the oldest is deleted.

    `keep` old files stay (0: none). The methods raise OSError and are not thread-safe.
    """

    def __init__(self, path: Path, rotate_bytes: int, keep: int) -> None:
        self.path = Path(path)
        self._rotate_bytes = rotate_bytes
        self._keep = keep
        self._descriptor = -1
        self._size = 0

    def open(self) -> None:
        """Open the file, creating its folder, and end a line that a crash left incomplete."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self._descriptor = os.open(self.path, _FLAGS | os.O_CREAT, 0o644)
        self._size = os.fstat(self._descriptor).st_size
        if self._size and os.pread(self._descriptor, 1, self._size - 1) != b"\n":
            self._put(b"\n")

    def probe(self) -> None:
        """Raise the OSError that `open` would raise; creates nothing."""
        try:
            os.close(os.open(self.path, _FLAGS))
        except FileNotFoundError:
            folder = next(each for each in self.path.absolute().parents if each.exists())
            if not os.access(folder, os.W_OK | os.X_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES)) from None

    def write(self, line: bytes) -> None:
        """Add one line, which ends with a line feed."""
        if self._size and self._size + len(line) > self._rotate_bytes:
            self._rotate()
        self._put(line)

    def close(self) -> None:
        descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            os.close(descriptor)

    def _put(self, data: bytes) -> None:
        self._size += len(data)
        view = memoryview(data)
        while view:
            view = view[os.write(self._descriptor, view) :]

    def _rotate(self) -> None:
        self.close()
        if self._keep <= 0:
            self.path.unlink()
        for number in range(self._keep, 0, -1):
            older = self._name(number)
            newer = self._name(number - 1) if number > 1 else self.path
            with contextlib.suppress(FileNotFoundError):
                newer.replace(older)
        self.open()

    def _name(self, number: int) -> Path:
        return self.path.with_name(f"{self.path.name}.{number}")


@implementer(ILogObserver)
class JsonLinesObserver:
    """Writes every event of level `least` and above as one JSON object per line, thread-safe.

    After a write error it stops permanently and calls `on_failure` once with the sentence.
    """

    def __init__(
        self, file: RotatingFile, least: NamedConstant, on_failure: Callable[[str], None]
    ) -> None:
        self._file = file
        self._least = least
        self._on_failure = on_failure
        self._lock = threading.Lock()
        self._writing = False

    def start(self) -> None:
        self._writing = True
        self._guarded(self._file.open)

    def stop(self) -> None:
        """Close the file; later events are dropped."""
        with self._lock:
            self._writing = False
            with contextlib.suppress(OSError):
                self._file.close()

    def __call__(self, event: LogEvent) -> None:
        """Write the event if it is severe enough."""
        if not self._writing or level_of(event) < self._least:
            return
        line = line_of(event, self._least)
        self._guarded(lambda: self._file.write(line))

    def _guarded(self, action: Callable[[], None]) -> None:
        with self._lock:
            if not self._writing:
                return
            try:
                action()
                return
            except OSError as error:
                self._writing = False
                reason = error.strerror or str(error)
                with contextlib.suppress(OSError):
                    self._file.close()
        # Outside the lock: the callback may log.
        self._on_failure(f"cannot write {self._file.path}, logging to it stops: {reason}")


def line_of(event: LogEvent, least: NamedConstant) -> bytes:
    """Return an event as one line of JSON: time (UTC), level, source, text and its own fields."""
    moment = datetime.fromtimestamp(event.get("log_time", 0.0), UTC)
    record: dict[str, Any] = {
        "time": moment.isoformat(timespec="milliseconds"),
        "level": word_of(level_of(event)).lower(),
        "source": source_of(event),
        "text": text_of(event),
    }
    fields = fields_of(event)
    if fields:
        record["fields"] = fields
    traceback = traceback_of(event, least)
    if traceback:
        record["traceback"] = traceback
    return json.dumps(record, allow_nan=False).encode("ascii") + b"\n"


def fields_of(event: LogEvent) -> dict[str, str | int | float | None]:
    """Return the fields of an event that JSON can hold, texts shortened."""
    return {
        name: _plain(value)
        for name, value in event.items()
        if not name.startswith("log_") and isinstance(value, str | int | float | None)
    }


def _plain(value: str | int | float | None) -> str | int | float | None:
    if isinstance(value, str):
        return value[:_MAX_FIELD]
    if isinstance(value, int) and value.bit_length() > 64:
        return "a huge number"
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    return value
