"""The first line of a connection: its name and the seat it requests (protocols, 9)."""

import re
from dataclasses import dataclass
from enum import Enum

from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE

HELLO_MAX_BYTES = 512
"""Maximum length of a hello, its LF included."""
HELLO_TIMEOUT_S = 5.0
"""Time limit for completing a hello."""
SILENCE_S = 1.0
"""A connection that sends nothing for this long is a thesis client."""
THESIS_AIRCRAFT = "default"
"""The aircraft of clients that never send a name."""

MALFORMED, TAKEN, FULL, ADDRESS, TOKEN = "malformed", "taken", "full", "address", "token"
CODES = (MALFORMED, TAKEN, FULL, ADDRESS, TOKEN)

_TOKEN = re.compile(r"[0-9A-Fa-f]{32,64}", re.ASCII)
_KEY = re.compile(r"[A-Za-z0-9_.-]+", re.ASCII)


class Side(Enum):
    """The port of a connection."""

    AIRBORNE = "airborne"
    GROUND = "ground"


class SeatKind(Enum):
    """The rights of a connection; the value is its word on the wire."""

    AIR = "air"
    COMMAND = "command"
    LISTEN = "listen"


@dataclass(frozen=True, slots=True)
class Hello:
    """A connection's hello; `token` is lower case, None if none was sent."""

    aircraft: str
    seat: SeatKind | None = None
    token: str | None = None


class HelloError(ValueError):
    """The reason for a refusal: a code of CODES and one sentence."""

    def __init__(self, code: str, reason: str) -> None:
        super().__init__(reason)
        self.code = code
        self.reason = reason


def _malformed(reason: str) -> HelloError:
    return HelloError(MALFORMED, reason)


def _words(line: bytes) -> dict[str, str]:
    """Return the key=value words after `UP1`."""
    if len(line) > HELLO_MAX_BYTES:
        raise _malformed(f"a hello is at most {HELLO_MAX_BYTES} bytes")
    try:
        text = line.decode("ascii")
    except UnicodeDecodeError:
        raise _malformed("a hello is ASCII") from None
    first, *rest = text.removesuffix("\n").split(" ")
    if first != "UP1":
        raise _malformed("the first line must begin with UP1")
    words: dict[str, str] = {}
    for word in rest:
        key, equals, value = word.partition("=")
        if not equals or not _KEY.fullmatch(key) or not value.isprintable():
            raise _malformed("a hello is words key=value with one space between them")
        if key in words:
            raise _malformed(f"{key[:32]} is said twice")
        words[key] = value
    return words


def parse_hello(line: bytes, side: Side) -> Hello:
    """Parse a first line, with or without its LF; unknown words are ignored.

    Raises HelloError with code `malformed`.
    """
    words = _words(line)
    name = words.get("aircraft", "")
    if not AIRCRAFT_NAME.fullmatch(name):
        raise _malformed(f"aircraft= must be {AIRCRAFT_NAME_RULE}")
    token = words.get("token")
    if token is not None and not _TOKEN.fullmatch(token):
        raise _malformed("token= must be 32 to 64 hexadecimal digits")
    return Hello(name, _seat(words.get("seat"), side), token and token.lower())


def _seat(word: str | None, side: Side) -> SeatKind | None:
    if side is Side.AIRBORNE:
        if word is not None:
            raise _malformed("the airborne side names no seat; grounds use the ground port")
        return None
    if word in (None, "command"):
        return SeatKind.COMMAND
    if word == "listen":
        return SeatKind.LISTEN
    raise _malformed("seat= must be command or listen")


def ok_line(aircraft: str, seat: SeatKind, token: str) -> bytes:
    """Return the answer to an accepted hello."""
    return f"UP1 ok aircraft={aircraft} seat={seat.value} token={token}\n".encode("ascii")


def error_line(error: HelloError) -> bytes:
    """Return the answer to a refused connection."""
    return f'UP1 error code={error.code} reason="{error.reason}"\n'.encode("ascii", "replace")
