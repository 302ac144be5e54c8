"""Control lines between the proxy and a ground: requests for the seat and its transfer."""

import re
from dataclasses import dataclass

PREFIX = b"UP1 "
"""Lines with this prefix are never relayed, in either direction."""
LISTEN = b"UP1 seat listen\n"
ONLINE = b"UP1 aircraft online\n"
OFFLINE = b"UP1 aircraft offline\n"

_GIVE = re.compile(rb"UP1 seat give to=([0-9]{1,9})")


@dataclass(frozen=True, slots=True)
class SeatRequest:
    """A listener requests the seat."""


@dataclass(frozen=True, slots=True)
class SeatRelease:
    """The holder releases the seat."""


@dataclass(frozen=True, slots=True)
class SeatGive:
    """The holder transfers the seat to the ground with this number."""

    to: int


Control = SeatRequest | SeatRelease | SeatGive


def parse_control(line: bytes) -> Control | None:
    """Parse a control line from a ground; None for an unknown request."""
    text = line.rstrip(b"\r\n")
    if text == b"UP1 seat request":
        return SeatRequest()
    if text == b"UP1 seat release":
        return SeatRelease()
    match = _GIVE.fullmatch(text)
    return SeatGive(int(match[1])) if match else None


def asked_line(number: int) -> bytes:
    """Return the line that tells the holder which ground requests the seat."""
    return b"UP1 seat asked by=%d\n" % number


def command_line(token: str) -> bytes:
    """Return the line that tells a ground that it has control."""
    return b"UP1 seat command token=%s\n" % token.encode("ascii")


def holder_line(number: int | None) -> bytes:
    """Return the line that tells every ground which one has control."""
    return b"UP1 seat holder=%d\n" % number if number is not None else b"UP1 seat holder=none\n"


def without_control(lines: bytes) -> tuple[bytes, list[bytes]]:
    """Split whole lines into those without the control lines, and the control lines.

    `lines` begins at the start of a line and ends with LF.
    """
    if PREFIX not in lines:
        return lines, []
    if not lines.startswith(PREFIX) and b"\n" + PREFIX not in lines:
        return lines, []
    relayed: list[bytes] = []
    control: list[bytes] = []
    for line in _split(lines):
        (control if line.startswith(PREFIX) else relayed).append(line)
    return b"".join(relayed), control


def _split(lines: bytes) -> list[bytes]:
    """Split at LF alone; bytes.splitlines would also split at CR."""
    return [line + b"\n" for line in lines.split(b"\n")[:-1]]
