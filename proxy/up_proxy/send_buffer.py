"""The lines that wait for a slow peer."""


class SendBuffer:
    """Whole lines that the socket has not taken yet.

    With `limit_bytes` the oldest whole lines are dropped when more waits (telemetry: the newest
    wins); with 0 nothing is dropped and the sender must wait. The rest of a partly sent line, and
    control lines, are never dropped.
    """

    __slots__ = ("_buffer", "_kept", "dropped_lines", "limit_bytes")

    def __init__(self, limit_bytes: int = 0) -> None:
        self.limit_bytes = limit_bytes
        self.dropped_lines = 0
        self._buffer = bytearray()
        self._kept = 0
        """Length of the head that must be sent unchanged."""

    def __len__(self) -> int:
        return len(self._buffer)

    @property
    def kept_bytes(self) -> int:
        return self._kept

    def put_rest(self, rest: bytes) -> None:
        """Start the queue; the first line, which is never dropped, may be partly sent."""
        assert not self._buffer
        self._buffer += rest
        self._kept = rest.find(b"\n") + 1

    def keep(self, count: int) -> None:
        """Keep at least this many bytes of the head unchanged, up to the end of a line."""
        if count > self._kept:
            self._kept = self._buffer.find(b"\n", count - 1) + 1 or len(self._buffer)

    def put(self, lines: bytes) -> None:
        buffer = self._buffer
        buffer += lines
        if not self.limit_bytes or len(buffer) <= self.limit_bytes:
            return
        last = min(self._kept + len(buffer) - self.limit_bytes, len(buffer)) - 1
        cut = buffer.find(b"\n", max(last, self._kept)) + 1
        if cut > self._kept:
            self.dropped_lines += buffer.count(b"\n", self._kept, cut)
            del buffer[self._kept : cut]

    def put_control(self, line: bytes) -> None:
        """Insert a control line at the first line boundary, ahead of all droppable lines."""
        self._buffer[self._kept : self._kept] = line
        self._kept += len(line)

    def head(self, size: int = 65536) -> bytes:
        return bytes(self._buffer[:size])

    def sent(self, count: int) -> None:
        buffer = self._buffer
        if count < self._kept:
            self._kept -= count
        elif count and buffer[count - 1] != 0x0A:
            self._kept = buffer.find(b"\n", count) + 1 - count
        else:
            self._kept = 0
        del buffer[:count]
