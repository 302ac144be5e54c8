"""The beginning of a line whose end has not come yet."""

LINE_MAX_BYTES = 65536
"""A connection that sends a longer line is closed."""


class HalfLine:
    """Cuts a stream of chunks at its last LF, so that only whole lines go on."""

    __slots__ = ("_held",)

    def __init__(self) -> None:
        self._held = bytearray()

    def __len__(self) -> int:
        return len(self._held)

    def starts_with(self, prefix: bytes) -> bool:
        """Say whether the unfinished line begins with `prefix`."""
        return self._held.startswith(prefix)

    def take(self, chunk: bytes) -> bytes:
        """Return the whole lines that `chunk` completes, empty when there is none."""
        cut = chunk.rfind(b"\n") + 1
        if not cut:
            self._held += chunk
            return b""
        whole = bytes(self._held) + chunk[:cut] if self._held else chunk[:cut]
        self._held = bytearray(chunk[cut:])
        return whole
