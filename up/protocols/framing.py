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
        """What an end sends first after it opened the line."""

    @property
    def last_sequence(self) -> int:
        """The sequence of the newest frame; answers carry it. 0 in thesis framing."""

    def encode(self, type_: int, payload: bytes = b"") -> bytes:
        """Return one frame, to be written at once."""


class FrameDecoder(Protocol):
    """Turns the bytes of the line into frames, whatever they are cut into."""

    @property
    def counters(self) -> FrameCounters:
        """What was received and what was dropped."""

    def feed(self, data: bytes, now: float | None = None) -> list[Frame]:
        """Return the frames that `data` completes; `now` is monotonic seconds."""

    def expire(self, now: float) -> list[Frame]:
        """Drop what is unfinished 100 ms after its newest byte; return what silence completes."""

    def reset(self) -> None:
        """Forget everything but the counters: the line was opened anew."""


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
