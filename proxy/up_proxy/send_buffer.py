"""The lines that wait for a slow peer."""

HEAD_BYTES = 65536
"""Handed to the socket in one call at most."""


class SendBuffer:
    """Whole lines that the socket has not taken yet.

    With `limit_bytes` the oldest whole lines are dropped when more waits (telemetry: the newest
    wins); with 0 nothing is dropped and the sender must wait. The rest of a partly sent line, and
    control lines, are never dropped.
    """

    __slots__ = ("_buffer", "dropped_lines", "kept_bytes", "limit_bytes")

    def __init__(self, limit_bytes: int) -> None:
        self.limit_bytes = limit_bytes
        self.dropped_lines = 0
        self._buffer = bytearray()
        self.kept_bytes = 0
        """Length of the head that must be sent unchanged."""

    def __len__(self) -> int:
        return len(self._buffer)

    def put_rest(self, rest: bytes) -> None:
        """Start the queue; the first line, which is never dropped, may be partly sent."""
        assert not self._buffer
        self._buffer += rest
        self.kept_bytes = rest.find(b"\n") + 1

    def keep(self, count: int) -> None:
        """Keep at least this many bytes of the head unchanged, up to the end of a line."""
        if count > self.kept_bytes:
            self.kept_bytes = self._buffer.find(b"\n", count - 1) + 1 or len(self._buffer)

    def put(self, lines: bytes) -> None:
        buffer = self._buffer
        buffer += lines
        if not self.limit_bytes or len(buffer) <= self.limit_bytes:
            return
        last = min(self.kept_bytes + len(buffer) - self.limit_bytes, len(buffer)) - 1
        cut = buffer.find(b"\n", max(last, self.kept_bytes)) + 1
        if cut > self.kept_bytes:
            self.dropped_lines += buffer.count(b"\n", self.kept_bytes, cut)
            del buffer[self.kept_bytes : cut]

    def put_control(self, line: bytes) -> None:
        """Insert a control line at the first line boundary, ahead of all droppable lines."""
        self._buffer[self.kept_bytes : self.kept_bytes] = line
        self.kept_bytes += len(line)

    def head(self) -> bytes:
        return bytes(self._buffer[:HEAD_BYTES])

    def sent(self, count: int) -> None:
        buffer = self._buffer
        if count < self.kept_bytes:
            self.kept_bytes -= count
        elif count and buffer[count - 1] != 0x0A:
            self.kept_bytes = buffer.find(b"\n", count) + 1 - count
        else:
            self.kept_bytes = 0
        del buffer[:count]
