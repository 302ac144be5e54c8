"""Splits a stream of bytes into lines of bounded length."""

from up.protocols.binary_line import TYPES

MAX_LINE_BYTES = 16384
"""Bytes of a General Message line with its LF (docs/protocols.md 4)."""


class LineBuffer:
    """Cuts a stream at its last LF, so that only whole lines pass; holds the partial line."""

    __slots__ = ("_partial",)

    def __init__(self) -> None:
        self._partial = bytearray()

    def __len__(self) -> int:
        return len(self._partial)

    def starts_with(self, prefix: bytes) -> bool:
        """Return whether the partial line begins with `prefix`."""
        return self._partial.startswith(prefix)

    def feed(self, data: bytes) -> bytes:
        """Return the whole lines that `data` completes, or empty bytes."""
        cut = data.rfind(b"\n") + 1
        if not cut:
            self._partial += data
            return b""
        whole = data[:cut]
        if self._partial:
            whole = bytes(self._partial) + whole
            self._partial.clear()
        if cut < len(data):
            self._partial += data[cut:]
        return whole

    def clear(self) -> None:
        self._partial.clear()


class LineDecoder:
    """Splits a stream at LF and removes a CR before it, except from a binary line.

    A line longer than `max_length` bytes, LF included, is dropped up to its LF and counted; memory
    stays below that bound for any input. Empty lines are heartbeats and are left out.
    """

    def __init__(self, max_length: int = MAX_LINE_BYTES) -> None:
        self.dropped_too_long = 0
        self._max_content = max_length - 1
        self._buffer = LineBuffer()
        self._is_skipping = False

    def feed(self, data: bytes) -> list[bytes]:
        """Return the lines that `data` completes, without their line ends."""
        if self._is_skipping:
            _, end, data = data.partition(b"\n")
            self._is_skipping = not end
        lines: list[bytes] = []
        for line in self._buffer.feed(data).split(b"\n")[:-1]:
            if len(line) > self._max_content:
                self.dropped_too_long += 1
            elif line[:1] and line[0] in TYPES:
                lines.append(line)
            elif content := line.removesuffix(b"\r"):
                lines.append(content)
        if len(self._buffer) > self._max_content:
            self.dropped_too_long += 1
            self._buffer.clear()
            self._is_skipping = True
        return lines

    def reset(self) -> None:
        """Discard an unfinished line: the next byte belongs to another connection."""
        self._buffer.clear()
        self._is_skipping = False
