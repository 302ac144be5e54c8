"""The lines between a proxy and its clients: hello, answer, control (docs/protocols.md 9).

The proxy, the aircraft's uplink and listener, and the ground use this codec. It keeps no state.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import fields
from enum import Enum
from typing import ClassVar

from up.quick_dataclass import dataclass
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE

PREFIX = b"UP1 "
"""Lines with this prefix are never relayed, in either direction."""
PREFIX_BYTE = PREFIX[0]
"""Its first byte, which Python finds in many lines ten times faster than several bytes."""
HELLO_MAX_BYTES = 512
"""Maximum length of a hello, its LF included."""

MALFORMED, TAKEN, FULL, ADDRESS, TOKEN = "malformed", "taken", "full", "address", "token"
NAME, CLUSTER, QUOTA = "name", "cluster", "quota"
CODES = (MALFORMED, TAKEN, FULL, ADDRESS, TOKEN, NAME, CLUSTER, QUOTA)
"""The codes of refusals."""

_TOKEN = re.compile(r"[0-9A-Fa-f]{32,64}", re.ASCII)
_KEY = re.compile(r"[A-Za-z0-9_.-]+", re.ASCII)
_NUMBER = re.compile(r"[0-9]{1,9}", re.ASCII)
_REFUSED = re.compile(r'UP1 error code=([a-z]{1,32}) reason="(.{0,400})"(?: .*)?', re.ASCII)
_WORDS = {None: "none", True: "online", False: "offline"}


class Side(Enum):
    """The side of the proxy that a client connects to."""

    AIRBORNE = "airborne"
    GROUND = "ground"


class Access(Enum):
    """The rights of a connection; the value is the word after `seat=`."""

    AIR = "air"
    COMMAND = "command"
    LISTEN = "listen"


class HelloError(ValueError):
    """A refused connection: a code of CODES and one sentence."""

    def __init__(self, code: str, reason: str) -> None:
        super().__init__(reason)
        self.code = code
        self.reason = reason


@dataclass(frozen=True, slots=True)
class _Line:
    FORMAT: ClassVar[str]

    def encode(self) -> bytes:
        values = {each.name: _word(getattr(self, each.name)) for each in fields(self)}
        return f"UP1 {self.FORMAT.format(**values)}\n".encode("ascii", "replace")


def _word(value: object) -> str:
    if isinstance(value, Access):
        return str(value.value)
    return _WORDS[value] if value is None or isinstance(value, bool) else str(value)


@dataclass(frozen=True, slots=True)
class Accepted(_Line):
    """Proxy to client: the hello is accepted; the token resumes this access."""

    FORMAT = "ok aircraft={aircraft} seat={access} token={token}"
    aircraft: str
    access: Access
    token: str


@dataclass(frozen=True, slots=True)
class Refused(_Line):
    """Proxy to client: the connection is refused and will be closed."""

    FORMAT = 'error code={code} reason="{reason}"'
    code: str
    reason: str


@dataclass(frozen=True, slots=True)
class ControlGranted(_Line):
    """Proxy to ground: this ground has control now."""

    FORMAT = "seat command token={token}"
    token: str


@dataclass(frozen=True, slots=True)
class ControlLost(_Line):
    """Proxy to ground: this ground listens now."""

    FORMAT = "seat listen"


@dataclass(frozen=True, slots=True)
class ControlRequested(_Line):
    """Proxy to the owner: a listener requests control."""

    FORMAT = "seat asked by={by}"
    by: int


@dataclass(frozen=True, slots=True)
class ControlOwner(_Line):
    """Proxy to all grounds: the ground that has control; None: no ground has it."""

    FORMAT = "seat holder={number}"
    number: int | None


@dataclass(frozen=True, slots=True)
class AircraftPresence(_Line):
    """Proxy to all grounds: the airborne side has connected or disconnected."""

    FORMAT = "aircraft {is_online}"
    is_online: bool


@dataclass(frozen=True, slots=True)
class Watchers(_Line):
    """Proxy to aircraft: the number of grounds; 1: all read packed telemetry, attitude frames.

    After each such line a ground may lack the present key.
    """

    FORMAT = "watch grounds={grounds} packed={packed} attitude={attitude}"
    grounds: int
    packed: int
    attitude: int = 0


@dataclass(frozen=True, slots=True)
class KeyRequest(_Line):
    """Ground to proxy: a frame of packed telemetry could not be read for want of its key."""

    FORMAT = "key"


@dataclass(frozen=True, slots=True)
class ControlRequest(_Line):
    """Ground to proxy: requests control."""

    FORMAT = "seat request"


@dataclass(frozen=True, slots=True)
class ControlRelease(_Line):
    """Owner to proxy: releases control."""

    FORMAT = "seat release"


@dataclass(frozen=True, slots=True)
class ControlGive(_Line):
    """Owner to proxy: hands control to the ground with this number."""

    FORMAT = "seat give to={to}"
    to: int


ProxyLine = (
    Accepted
    | Refused
    | ControlGranted
    | ControlLost
    | ControlRequested
    | ControlOwner
    | AircraftPresence
    | Watchers
)
GroundLine = KeyRequest | ControlRequest | ControlRelease | ControlGive

_LINES: dict[str, Callable[[Mapping[str, str]], ProxyLine | GroundLine]] = {
    "ok": lambda words: Accepted(words["aircraft"], Access(words["seat"]), _token(words["token"])),
    "seat command": lambda words: ControlGranted(_token(words["token"])),
    "seat listen": lambda words: ControlLost(),
    "seat asked": lambda words: ControlRequested(_number(words["by"])),
    "seat": lambda words: ControlOwner(
        None if words["holder"] == "none" else _number(words["holder"])
    ),
    "aircraft online": lambda words: AircraftPresence(True),
    "aircraft offline": lambda words: AircraftPresence(False),
    "watch": lambda words: Watchers(
        _number(words["grounds"]), int(words["packed"] == "1"), int(words.get("attitude") == "1")
    ),
    "key": lambda words: KeyRequest(),
    "seat request": lambda words: ControlRequest(),
    "seat release": lambda words: ControlRelease(),
    "seat give": lambda words: ControlGive(_number(words["to"])),
}
"""The lines by their words without a value; the words with one make the fields."""


def parse_line(line: bytes) -> ProxyLine | GroundLine | None:
    """Parse any line but a hello, with or without its line end; None for an unknown one.

    Unknown `key=value` words are ignored.
    """
    text = line.rstrip(b"\r\n").decode("ascii", "replace")
    if not text.isascii() or not text.isprintable() or not text.startswith("UP1 "):
        return None
    refused = _REFUSED.fullmatch(text)
    if refused is not None:
        return Refused(refused[1], refused[2])
    words = text.split(" ")[1:]
    make = _LINES.get(" ".join(word for word in words if "=" not in word))
    try:
        return make and make(dict(word.split("=", 1) for word in words if "=" in word))
    except (KeyError, ValueError):
        return None


def _token(text: str) -> str:
    if not is_token(text):
        raise ValueError(text)
    return text


def _number(text: str) -> int:
    if not _NUMBER.fullmatch(text):
        raise ValueError(text)
    return int(text)


def is_token(text: str) -> bool:
    """Return whether a text has the form of a resume token as a proxy writes it."""
    return _TOKEN.fullmatch(text) is not None and text == text.lower()


@dataclass(frozen=True, slots=True)
class Hello:
    """The first line of a client. `access` None: the airborne side; `token` None or "": none.

    `packed`: the client sends or reads packed telemetry, and knows `Watchers` and `KeyRequest`.
    `attitude`: a ground also reads attitude frames, and short protected messages.
    """

    aircraft: str
    access: Access | None = None
    token: str | None = None
    packed: bool = False
    attitude: bool = False

    def encode(self) -> bytes:
        packed = " packed=1" * self.packed + " attitude=1" * self.attitude
        access = f" seat={self.access.value}" if self.access else ""
        token = f" token={self.token}" if self.token else ""
        return f"UP1 aircraft={self.aircraft}{access}{token}{packed}\n".encode("ascii")


def parse_hello(line: bytes, side: Side) -> Hello:
    """Parse a first line, with or without its LF; unknown words are ignored.

    A ground that names no access requests control. Raises HelloError with code `malformed`.
    """
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
            raise _malformed(f"duplicate word {key[:32]}=")
        words[key] = value
    name, token = words.get("aircraft", ""), words.get("token")
    if not AIRCRAFT_NAME.fullmatch(name):
        raise _malformed(f"aircraft= must be {AIRCRAFT_NAME_RULE}")
    if token is not None and not _TOKEN.fullmatch(token):
        raise _malformed("token= must be 32 to 64 hexadecimal digits")
    access = _access(words.get("seat"), side)
    packed, attitude = (words.get(key) == "1" for key in ("packed", "attitude"))
    return Hello(name, access, token and token.lower(), packed, attitude)


def _access(word: str | None, side: Side) -> Access | None:
    if side is Side.AIRBORNE:
        if word is not None:
            raise _malformed("seat= is for grounds, which use the ground port")
        return None
    if word not in (None, "command", "listen"):
        raise _malformed("seat= must be command or listen")
    return Access(word or "command")


def _malformed(reason: str) -> HelloError:
    return HelloError(MALFORMED, reason)
