"""The two framings of the serial line by name."""

from collections.abc import Mapping
from types import MappingProxyType

from up.protocols.checked_framing import CheckedDecoder, CheckedEncoder
from up.protocols.thesis_framing import ThesisDecoder, ThesisEncoder

FrameEncoder = CheckedEncoder | ThesisEncoder
FrameDecoder = CheckedDecoder | ThesisDecoder
FRAMINGS = ("checked", "thesis")


def make_framing(
    name: str, sizes: Mapping[int, int], least: Mapping[int, int] = MappingProxyType({})
) -> tuple[FrameEncoder, FrameDecoder]:
    """Return the encoder and decoder called `name`, one of `FRAMINGS`.

    `sizes` maps each type byte that may arrive to the size of its payload, 0 to 96. Checked
    framing takes any size from `least` on of the types that it names.
    """
    if name == "checked":
        return CheckedEncoder(), CheckedDecoder(sizes, least)
    return ThesisEncoder(), ThesisDecoder(sizes)
