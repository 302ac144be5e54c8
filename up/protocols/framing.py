"""The two framings of the serial line by name."""

from __future__ import annotations

from collections.abc import Mapping

from up.protocols.checked_framing import CheckedDecoder, CheckedEncoder
from up.protocols.thesis_framing import ThesisDecoder, ThesisEncoder

FrameEncoder = CheckedEncoder | ThesisEncoder
FrameDecoder = CheckedDecoder | ThesisDecoder
FRAMINGS = ("checked", "thesis")


def make_framing(name: str, sizes: Mapping[int, int]) -> tuple[FrameEncoder, FrameDecoder]:
    """Return the encoder and decoder called `name`, one of `FRAMINGS`.

    `sizes` maps each type byte that may arrive to the size of its payload, 0 to 96.
    """
    if name == "checked":
        return CheckedEncoder(), CheckedDecoder(sizes)
    return ThesisEncoder(), ThesisDecoder(sizes)
