"""DisplayPort over MSP: a board sends text, the goggles' video transmitter draws it.

The format is Betaflight's (betaflight.com/docs/development/API/DisplayPort): message 182 from the
board, whose first byte is one of five operations.
"""

import struct
from collections.abc import Mapping

from msp_cog.codec import ERROR, REPLY, encode

DISPLAYPORT = 182
HEARTBEAT, RELEASE, CLEAR, WRITE, DRAW = range(5)
MAX_TEXT = 30
"""Characters of one WRITE."""
FIRST_CHARACTER, LAST_CHARACTER = 0x20, 0x5F
"""The characters that every font of the goggles has; symbols are beyond them, and lower case."""

FC_VARIANT, VTX_CONFIG, STATUS, BOX_IDS, SET_OSD_CANVAS, OSD_CANVAS = 2, 88, 101, 119, 188, 189
_STATUS = struct.Struct("<6xI3x")
_OTHER_VTX = b"\xff"


def operation(code: int) -> bytes:
    """Return the frame of an operation without text."""
    return encode(DISPLAYPORT, bytes((code,)), REPLY)


def write(row: int, column: int, text: str) -> bytes:
    """Return the frame that writes at most 30 characters at a place, counted from 0."""
    return encode(DISPLAYPORT, bytes((WRITE, row, column, 0)) + text.encode("ascii"), REPLY)


def plain(text: str) -> str:
    """Return a text in the characters that the goggles have; a question mark for any other."""
    return "".join(
        each if FIRST_CHARACTER <= ord(each) <= LAST_CHARACTER else "?" for each in text.upper()
    )


def answers(grid: tuple[int, int], *, is_armed: bool) -> Mapping[int, bytes]:
    """Return the payloads of the answers by the number of the request.

    Goggles ask for the board's kind (by it they select their font), its grid of columns and rows,
    and whether it is armed (then some video transmitters raise their power). The channel and power
    of the transmitter are its own.
    """
    return {
        FC_VARIANT: b"BTFL",
        VTX_CONFIG: _OTHER_VTX,
        STATUS: _STATUS.pack(is_armed),
        BOX_IDS: b"\0",
        SET_OSD_CANVAS: b"",
        OSD_CANVAS: bytes(grid),
    }


def answer(number: int, known: Mapping[int, bytes]) -> bytes:
    """Return the frame that answers a request; one without an answer is refused."""
    payload = known.get(number)
    return encode(number, head=ERROR) if payload is None else encode(number, payload, REPLY)
