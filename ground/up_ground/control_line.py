"""The control lines between a proxy and a ground, in both directions (docs/protocols.md 9)."""

from __future__ import annotations

import re
from dataclasses import dataclass

from up_ground.settings import Seat

PREFIX = b"UP1 "
SEAT_REQUEST = b"UP1 seat request\n"
SEAT_RELEASE = b"UP1 seat release\n"

_TOKEN = re.compile(r"[0-9a-f]{32,64}", re.ASCII)
_NUMBER = re.compile(r"[0-9]{1,9}", re.ASCII)
_ERROR = re.compile(r'UP1 error code=([a-z]{1,32}) reason="(.{0,400})"', re.ASCII)


@dataclass(frozen=True, slots=True)
class Accepted:
    """The hello was accepted: which seat was given, and the token that resumes it."""

    seat: Seat
    token: str


@dataclass(frozen=True, slots=True)
class Rejected:
    """The hello was refused; the proxy closes the connection."""

    code: str
    reason: str


@dataclass(frozen=True, slots=True)
class SeatGained:
    """This ground commands now."""

    token: str


@dataclass(frozen=True, slots=True)
class SeatLost:
    """This ground listens now."""


@dataclass(frozen=True, slots=True)
class SeatAsked:
    """A listener requests the seat from this ground."""

    by: int


@dataclass(frozen=True, slots=True)
class SeatHolder:
    """The ground that commands; None: the seat is free."""

    number: int | None


@dataclass(frozen=True, slots=True)
class AircraftPresence:
    """The airborne side has connected or disconnected."""

    is_online: bool


ProxyLine = Accepted | Rejected | SeatGained | SeatLost | SeatAsked | SeatHolder | AircraftPresence


def hello_line(aircraft: str, seat: Seat, token: str | None) -> bytes:
    """Return a ground's first line."""
    resume = f" token={token}" if token else ""
    return f"UP1 aircraft={aircraft} seat={seat.value}{resume}\n".encode("ascii")


def give_line(to: int) -> bytes:
    """Return the line that hands the seat to ground ``to``."""
    return b"UP1 seat give to=%d\n" % to


def is_token(text: str) -> bool:
    """Return whether a text has the form of a resume token."""
    return _TOKEN.fullmatch(text) is not None


def parse_proxy_line(line: bytes) -> ProxyLine | None:
    """Return the parsed control line; None for an unknown one.

    ``line`` has no line end. Unknown ``key=value`` words are ignored.
    """
    try:
        text = line.decode("ascii")
    except UnicodeDecodeError:
        return None
    if not text.isprintable():
        return None
    error = _ERROR.fullmatch(text)
    if error is not None:
        return Rejected(error[1], error[2])
    first, *rest = text.split(" ")
    if first != "UP1" or not rest:
        return None
    kind = rest[0]
    if kind == "aircraft":
        return _presence(rest[1:])
    words = dict(word.split("=", 1) for word in rest if "=" in word)
    if kind == "ok":
        return _accepted(words)
    return _seat_line(rest[1:], words) if kind == "seat" else None


def _presence(words: list[str]) -> AircraftPresence | None:
    if words[:1] == ["online"]:
        return AircraftPresence(True)
    return AircraftPresence(False) if words[:1] == ["offline"] else None


def _accepted(words: dict[str, str]) -> Accepted | None:
    seat, token = words.get("seat", ""), words.get("token", "")
    if seat not in ("command", "listen") or not is_token(token):
        return None
    return Accepted(Seat(seat), token)


def _seat_line(rest: list[str], words: dict[str, str]) -> ProxyLine | None:
    verb = rest[0] if rest else ""
    if verb == "command":
        token = words.get("token", "")
        return SeatGained(token) if is_token(token) else None
    if verb == "listen":
        return SeatLost()
    if verb == "asked":
        number = _number(words.get("by", ""))
        return None if number is None else SeatAsked(number)
    if words.get("holder") == "none":
        return SeatHolder(None)
    number = _number(words.get("holder", ""))
    return None if number is None else SeatHolder(number)


def _number(text: str) -> int | None:
    return int(text) if _NUMBER.fullmatch(text) else None
