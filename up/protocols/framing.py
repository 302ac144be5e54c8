"""The two framings of the serial line behind one interface."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from up.protocols.checked_framing import CheckedDecoder, CheckedEncoder
from up.protocols.frame import Frame, FrameCounters
from up.protocols.thesis_framing import ThesisDecoder, ThesisEncoder

FRAMINGS = ("checked", "thesis")


class FrameEncoder(Protocol):
    """Turns a type and a payload into the bytes of one frame."""

    @property
    def opening(self) -> bytes:
        """The bytes that an end sends first after it opened the line."""

    @property
    def last_sequence(self) -> int:
        """The sequence of the newest frame, which answers carry; 0 in thesis framing."""

    def encode(self, type_: int, payload: bytes = b"") -> bytes:
        """Return one frame, to be written immediately."""


class FrameDecoder(Protocol):
    """Turns the bytes of the line into frames, in pieces of any size."""

    @property
    def counters(self) -> FrameCounters:
        """Counters of received and dropped frames."""

    def feed(self, data: bytes, now: float = 0.0) -> list[Frame]:
        """Return the frames that `data` completes; `now` is monotonic seconds."""

    def expire(self, now: float) -> list[Frame]:
        """Drop an unfinished frame 100 ms after its newest byte; return those that silence ends."""

    def reset(self) -> None:
        """Discard everything but the counters: the line was reopened."""


def make_framing(name: str, sizes: Mapping[int, int]) -> tuple[FrameEncoder, FrameDecoder]:
    """Return the encoder and decoder called `name`, one of `FRAMINGS`.

    `sizes` maps each type byte that may arrive to the size of its payload, 0 to 96.
    Raises ValueError for another name.
    """
    if name == "checked":
        return CheckedEncoder(), CheckedDecoder(sizes)
    if name == "thesis":
        return ThesisEncoder(), ThesisDecoder(sizes)
    raise ValueError(f"framing is {name!r}, expected one of {', '.join(FRAMINGS)}")
