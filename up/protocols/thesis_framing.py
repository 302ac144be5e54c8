"""Thesis framing of the serial line: type and payload, bare (thesis figure 3.3)."""

from collections.abc import Mapping

from up.protocols.frame import UNFINISHED_TIMEOUT_S, Frame, FrameCounters

REFUSED = 0x21
"""`!`: followed by the refused type, or by nothing (docs/protocols.md 2.4)."""


class ThesisEncoder:
    """Builds bare frames for an old firmware."""

    opening = b""
    last_sequence = 0

    def encode(self, type_: int, payload: bytes = b"") -> bytes:
        return bytes((type_,)) + payload


class ThesisDecoder:
    """Finds bare frames in a stream of bytes that may also hold plain text.

    Frames have no delimiter, so an unknown byte is dropped alone and counted. The sequence of every
    frame is 0. The size of `!` in `sizes` is ignored: its payload is the refused type or empty.
    """

    def __init__(self, sizes: Mapping[int, int]) -> None:
        self.counters = FrameCounters()
        self._sizes = dict(sizes)
        self._tail = b""
        self._newest_byte_s = 0.0

    def feed(self, data: bytes, now: float = 0.0) -> list[Frame]:
        frames = self.expire(now)
        self._newest_byte_s = now
        return frames + self._take(self._tail + data, is_silent=False)

    def expire(self, now: float) -> list[Frame]:
        """Drop an unfinished frame after 100 ms; return a `!` that was waiting."""
        if not self._tail or now < self._newest_byte_s + UNFINISHED_TIMEOUT_S:
            return []
        frames = self._take(self._tail, is_silent=True)
        if self._tail:
            self.counters.timeouts += 1
            self._tail = b""
        return frames

    def reset(self) -> None:
        self._tail = b""

    def _take(self, buffer: bytes, *, is_silent: bool) -> list[Frame]:
        """Return the frames at the front of `buffer` and keep the rest."""
        frames: list[Frame] = []
        sizes = self._sizes
        position = 0
        end = len(buffer)
        while position < end:
            type_ = buffer[position]
            size = sizes.get(type_)
            if size is None:
                self.counters.unknown_types += 1
                position += 1
                continue
            if type_ == REFUSED:
                refused_size = self._refused_size(buffer, position + 1, is_silent=is_silent)
                if refused_size is None:
                    break
                size = refused_size
            following = position + 1 + size
            if following > end:
                break
            frames.append((type_, buffer[position + 1 : following], 0))
            position = following
        self._tail = buffer[position:]
        self.counters.frames += len(frames)
        return frames

    def _refused_size(self, buffer: bytes, start: int, *, is_silent: bool) -> int | None:
        """Return how many bytes belong to a `!` before `start`; None to wait for more.

        A type without payload is taken as the refused one: reading the refusal of an Arm as `!` and
        *armed* would be the worse error.
        """
        if start == len(buffer):
            return 0 if is_silent else None
        size = self._sizes.get(buffer[start])
        if not size:
            return 1
        if buffer[start] == REFUSED:
            return 0
        if start + 1 + size <= len(buffer):
            return 0
        return 1 if is_silent else None
