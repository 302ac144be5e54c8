"""The beginning of a line without its end."""

LINE_MAX_BYTES = 65536
"""A connection that sends a longer line is closed."""


class HalfLine:
    """Cuts a stream of chunks at its last LF, so that only whole lines pass."""

    __slots__ = ("_held",)

    def __init__(self) -> None:
        self._held = bytearray()

    def __len__(self) -> int:
        return len(self._held)

    def starts_with(self, prefix: bytes) -> bool:
        """Return whether the partial line begins with `prefix`."""
        return self._held.startswith(prefix)

    def take(self, chunk: bytes) -> bytes:
        """Return the whole lines that `chunk` completes, or empty bytes."""
        cut = chunk.rfind(b"\n") + 1
        if not cut:
            self._held += chunk
            return b""
        whole = bytes(self._held) + chunk[:cut] if self._held else chunk[:cut]
        self._held = bytearray(chunk[cut:])
        return whole
