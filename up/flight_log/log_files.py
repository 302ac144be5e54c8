"""Reads single messages from the parts of a log, in the order of their positions."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from up.flight_log.mcap_format import FlightLogError

_WINDOW = 64 * 1024
_MAX_OPEN = 16
_NEAR = 4 * 1024
"""Messages at most this far apart are read together."""


class LogFiles:
    """The parts, opened on first use; close it, or use it as a context.

    Adjacent messages share one system call; a scattered one costs one call and loads nothing else.
    """

    def __init__(self, paths: Sequence[Path]) -> None:
        self._paths = paths
        self._descriptors: dict[int, int] = {}
        self._segment = -1
        self._begin = 0
        self._end = 0
        self._window = b""

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close every file."""
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
            descriptor = self._descriptors.get(part)
            if descriptor is None:
                if len(self._descriptors) >= _MAX_OPEN:
                    self.close()
                flags = os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK
                descriptor = self._descriptors[part] = os.open(self._paths[part], flags)
            self._window = os.pread(descriptor, size, offset)
        except OSError as error:
            text = f"cannot read {self._paths[part].name}: {error.strerror or error}"
            raise FlightLogError(text, "unreadable") from None
        self._segment, self._begin, self._end = part, offset, offset + len(self._window)
