"""Splits a stream of bytes into lines of bounded length."""

from __future__ import annotations

MAX_LINE_BYTES = 16384
"""Bytes of a General Message line with its LF (docs/protocols.md 4)."""


class LineDecoder:
    """Splits a stream at LF and removes a CR before it.

    A line longer than `max_length` bytes, LF included, is dropped up to its LF and counted; memory
    stays below that bound for any input. Empty lines are heartbeats and are left out.
    """

    def __init__(self, max_length: int = MAX_LINE_BYTES) -> None:
        self.dropped_too_long = 0
        self._max_content = max_length - 1
        self._parts: list[bytes] = []
        self._held = 0
        self._is_skipping = False

    def feed(self, data: bytes) -> list[bytes]:
        """Return the lines that `data` completes, without their line ends."""
        pieces = data.split(b"\n")
        tail = pieces.pop()
        lines: list[bytes] = []
        if pieces:
            first = pieces[0]
            if self._is_skipping:
                self._is_skipping = False
                first = b""
            elif self._parts:
                first = b"".join((*self._parts, first))
            pieces[0] = first
            self._parts.clear()
            self._held = 0
            for line in pieces:
                if len(line) > self._max_content:
                    self.dropped_too_long += 1
                    continue
                content = line.removesuffix(b"\r")
                if content:
                    lines.append(content)
        if tail and not self._is_skipping:
            self._hold(tail)
        return lines

    def reset(self) -> None:
        """Discard an unfinished line: the next byte belongs to another connection."""
        self._parts.clear()
        self._held = 0
        self._is_skipping = False

    def _hold(self, tail: bytes) -> None:
        self._held += len(tail)
        if self._held > self._max_content:
            self.dropped_too_long += 1
            self._parts.clear()
            self._held = 0
            self._is_skipping = True
        else:
            self._parts.append(tail)
