"""Reads single messages from the parts of a log, in the order of their positions."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Self

from up.flight_log.mcap_format import FlightLogError
from up_flightlog.read.expanded_records import ExpandedRecords
from up_flightlog.read.log_index import EXPANDED

_WINDOW = 64 * 1024
_MAX_OPEN = 16
_NEAR = 4 * 1024
"""Messages at most this far apart are read together."""


class LogFiles:
    """The parts, opened on first use; close it, or use it as a context.

    Offsets from ``EXPANDED`` on are in ``expanded``. Adjacent messages share one system call; a
    scattered one costs one call and loads nothing else.
    """

    def __init__(self, paths: Sequence[Path], expanded: ExpandedRecords | None = None) -> None:
        self._paths = paths
        self._expanded = expanded
        self._descriptors: dict[int, int] = {}
        self._segment = -1
        self._begin = 0
        self._end = 0
        self._window = b""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def read(self, part: int, offset: int, size: int) -> bytes:
        """Return this many bytes of a part; raises FlightLogError."""
        begin = offset - self._begin
        if part != self._segment or begin < 0 or offset + size > self._end:
            is_near = part == self._segment and 0 <= offset - self._end <= _NEAR
            self._fill(part, offset, max(size, _WINDOW) if is_near else size)
            begin = 0
            if self._end - offset < size:
                text = f"{self._paths[part].name}: it became shorter after it was indexed"
                raise FlightLogError(text, "truncated")
        return self._window[begin : begin + size]

    def close(self) -> None:
        """Close every file; idempotent."""
        descriptors, self._descriptors = self._descriptors, {}
        for each in descriptors.values():
            os.close(each)

    def _fill(self, part: int, offset: int, size: int) -> None:
        try:
            if offset >= EXPANDED and self._expanded is not None:
                self._window = self._expanded.read(offset - EXPANDED, size)
            else:
                self._window = os.pread(self._descriptor(part), size, offset)
        except OSError as error:
            text = f"cannot read {self._paths[part].name}: {error.strerror or error}"
            raise FlightLogError(text, "unreadable") from None
        self._segment, self._begin, self._end = part, offset, offset + len(self._window)

    def _descriptor(self, part: int) -> int:
        descriptor = self._descriptors.get(part)
        if descriptor is None:
            if len(self._descriptors) >= _MAX_OPEN:
                self.close()
            flags = os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK
            descriptor = self._descriptors[part] = os.open(self._paths[part], flags)
        return descriptor


def is_being_recorded(path: Path) -> bool:
    """Return whether the black box still writes the file: it holds a lock on it."""
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False
