"""A progress line for long operations on a terminal."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Self, TextIO

AFTER_S = 0.5
_BETWEEN_S = 0.1


class Progress:
    """Shows ``text 12 of 300`` on a terminal once the operation has taken half a second.

    Use it as a context: the line is removed at the end. Prints nothing to a file or a pipe.
    """

    def __init__(self, text: str, count: int, stream: TextIO | None = None) -> None:
        self._text = text
        self._count = count
        self._stream = stream or sys.stderr
        self._is_seen = self._stream.isatty()
        self._due_s = time.monotonic() + AFTER_S
        self._has_spoken = False

    def at(self, number: int) -> None:
        """Report the current item; the first is 1."""
        if self._is_seen and time.monotonic() >= self._due_s:
            self._due_s = time.monotonic() + _BETWEEN_S
            self._has_spoken = True
            self._say(f"\r{self._text} {number} of {self._count}")

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Remove the line."""
        if self._has_spoken:
            self._say("\r\x1b[K")

    def _say(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
