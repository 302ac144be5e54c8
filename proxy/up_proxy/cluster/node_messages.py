"""What the nodes of a cluster send each other about an aircraft, as bytes."""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from functools import lru_cache
from typing import Any, NamedTuple

from up.protocols.proxy_lines import Access
from up.quick_dataclass import dataclass
from up_proxy.tenant_quota import Usage

ENVELOPE = b"%b %d %d %d\n%b"
"""A message as bytes: the fields of `Envelope`, the time in milliseconds."""
MAX_NUMBER = 2**53
_MAX_DIGITS = 16
_MAX_HEADER = 32 + 3 * (1 + _MAX_DIGITS)
"""Bytes of a node's name and three numbers of 16 digits."""
_tuple_new = tuple.__new__
"""Without the call that a NamedTuple makes in Python."""
_NAME = re.compile(r"[!-~]{1,32}", re.ASCII)
_BEACON = b'{"online"'
_JSON = json.JSONEncoder(separators=(",", ":"))


class MalformedError(ValueError):
    """A message of no node of this version."""


class Envelope(NamedTuple):
    """A message: its sender, the fencing number it goes by, its time, its ground, the rest."""

    node: str
    fence: int
    sent_s: float
    ground: int
    body: bytes


def unpack(payload: bytes) -> Envelope:
    """Return the parts of a message. Raises MalformedError."""
    # The path of every relayed line: a regular expression takes twice as long.
    header, _, body = payload.partition(b"\n")
    try:
        name, fence, sent_ms, ground = header.split(b" ")
        if (
            len(header) <= _MAX_HEADER
            and fence.isdigit()
            and sent_ms.isdigit()
            and ground.isdigit()
        ):
            fields = _known_name(name), int(fence), int(sent_ms) / 1000, int(ground), body
            return _tuple_new(Envelope, fields)
    except ValueError:
        pass
    raise MalformedError("header")


@lru_cache(256)
def _known_name(name: bytes) -> str:
    """Return a node's name as text. Raises ValueError."""
    node = name.decode("ascii")
    if not _NAME.fullmatch(node):
        raise ValueError(node)
    return node


@dataclass(frozen=True, slots=True)
class ListedGround:
    """A ground of a guest. `age_s`: since its last byte."""

    number: int
    access: Access
    token: str
    packed: bool
    attitude: bool
    host: str
    age_s: float

    def encode(self) -> list[object]:
        words = self.number, self.access.value, self.token, int(self.packed), int(self.attitude)
        return [*words, self.host, round(self.age_s, 2)]


@dataclass(frozen=True, slots=True)
class GroundList:
    """Guest to home: all its grounds of the aircraft."""

    grounds: tuple[ListedGround, ...]

    def encode(self) -> bytes:
        return _encode({"grounds": [each.encode() for each in self.grounds]})


@dataclass(frozen=True, slots=True)
class Beacon:
    """Home to guests: the aircraft's state; `known`: the admitted grounds of each guest."""

    online: bool
    owner: int | None
    known: Mapping[str, Iterable[int]] = field(default_factory=dict)

    def encode(self) -> bytes:
        known = {node: sorted(numbers) for node, numbers in self.known.items()}
        return _encode({"online": self.online, "owner": self.owner, "known": known})


@dataclass(frozen=True, slots=True)
class GroundLine:
    """Home to one ground of a guest: a line of the proxy."""

    node: str
    line: bytes

    def encode(self) -> bytes:
        return _encode({"to": self.node, "line": self.line.decode("ascii")})


def parse(body: bytes) -> GroundList | Beacon | GroundLine:
    """Return what a control message states. Raises MalformedError."""
    # Each second a home sends the same beacon, until something changes.
    return _parse_cached(body) if body.startswith(_BEACON) else _parse(body)


def _parse(body: bytes) -> GroundList | Beacon | GroundLine:
    try:
        fields: dict[str, Any] = json.loads(body)
        if "grounds" in fields:
            return GroundList(tuple(map(_ground, fields["grounds"])))
        if "to" in fields:
            return GroundLine(str(fields["to"]), str(fields["line"]).encode("ascii"))
        owner = fields["owner"]
        known = {str(node): list(map(_number, each)) for node, each in fields["known"].items()}
        return Beacon(bool(fields["online"]), None if owner is None else _number(owner), known)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise MalformedError(str(error)) from None


_parse_cached = lru_cache(1024)(_parse)


def pack_batch(entries: Iterable[tuple[str, int, bytes]]) -> bytes:
    """Return the body of a message with lists and beacons of several aircraft: a line for each."""
    lines = (b"%b %d %b\n" % (name.encode("ascii"), fence, body) for name, fence, body in entries)
    return b"".join(lines)


def parse_batch(body: bytes) -> Iterator[tuple[str, int, bytes]]:
    """Yield aircraft, fencing number and message. Raises MalformedError."""
    for line in body.splitlines():
        name, _, rest = line.partition(b" ")
        fence, _, message = rest.partition(b" ")
        if not name.isascii() or not fence.isdigit() or len(fence) > _MAX_DIGITS:
            raise MalformedError("batch")
        yield name.decode("ascii"), int(fence), message


def encode_usage(usage: Usage) -> bytes:
    """Return the body of a heartbeat."""
    return _encode(usage._asdict())


def parse_usage(body: bytes) -> Usage:
    """Return what a heartbeat states. Raises MalformedError."""
    try:
        fields = json.loads(body)
        return Usage(*(_number(fields[kind]) for kind in Usage._fields))
    except (ValueError, TypeError, KeyError, RecursionError) as error:
        raise MalformedError(str(error)) from None


def _ground(words: list[Any]) -> ListedGround:
    number, access, token, packed, attitude, host, age_s = words
    return ListedGround(
        _number(number), Access(access), str(token), packed == 1, attitude == 1,
        str(host), min(max(float(age_s), 0.0), 1e6),
    )  # fmt: skip


def _number(value: Any) -> int:
    if type(value) is not int or not 0 <= value < MAX_NUMBER:
        raise ValueError(value)
    return value


def _encode(fields: dict[str, object]) -> bytes:
    return _JSON.encode(fields).encode("ascii")
