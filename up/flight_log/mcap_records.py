"""The records of MCAP as values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from zlib import crc32

from up.flight_log.mcap_format import ATTACHMENT, CHANNEL, MESSAGE, U16, U32, U64


class MalformedRecordError(ValueError):
    """The content of a record violates its layout; the text says how."""


@dataclass(frozen=True, slots=True)
class Header:
    """The program that wrote the file."""

    profile: str
    library: str


@dataclass(frozen=True, slots=True)
class Schema:
    """The layout of a channel's messages."""

    id: int
    name: str
    encoding: str
    data: bytes


@dataclass(frozen=True, slots=True)
class Channel:
    """A stream of messages of one topic."""

    id: int
    schema_id: int
    topic: str
    encoding: str
    metadata: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Message:
    """One message; times are nanoseconds since 1970."""

    channel_id: int
    sequence: int
    log_time_ns: int
    publish_time_ns: int
    data: bytes


@dataclass(frozen=True, slots=True)
class AttachedFile:
    """An attached file: the position of its ``size`` bytes, and whether they are undamaged."""

    name: str
    media_type: str
    log_time_ns: int
    offset: int
    size: int
    is_intact: bool


@dataclass(frozen=True, slots=True)
class Metadata:
    """Texts by name."""

    name: str
    values: Mapping[str, str]


class Fields:
    """The fields of one record's content in order; MalformedRecordError if it is too short."""

    def __init__(self, content: bytes) -> None:
        self.at = 0
        self._content = content

    def u16(self) -> int:
        """Return a number of two bytes."""
        return U16.unpack(self.take(U16.size))[0]  # type: ignore[no-any-return]

    def u32(self) -> int:
        """Return a number of four bytes."""
        return U32.unpack(self.take(U32.size))[0]  # type: ignore[no-any-return]

    def u64(self) -> int:
        """Return a number of eight bytes."""
        return U64.unpack(self.take(U64.size))[0]  # type: ignore[no-any-return]

    def text(self) -> str:
        """Return a text."""
        try:
            return self.take(self.u32()).decode("utf-8")
        except UnicodeDecodeError:
            raise MalformedRecordError("a text that is not UTF-8") from None

    def map(self) -> dict[str, str]:
        """Return texts by name."""
        end = self.u32() + self.at
        values: dict[str, str] = {}
        while self.at < end:
            name = self.text()
            values[name] = self.text()
        return values

    def take(self, size: int) -> bytes:
        """Return this many bytes."""
        begin, self.at = self.at, self.at + size
        if self.at > len(self._content):
            raise MalformedRecordError("a field that is longer than its record")
        return self._content[begin : self.at]


def read_header(content: bytes) -> Header:
    """Return the header of a file."""
    fields = Fields(content)
    return Header(fields.text(), fields.text())


def read_schema(content: bytes) -> Schema:
    """Return a schema."""
    fields = Fields(content)
    return Schema(fields.u16(), fields.text(), fields.text(), fields.take(fields.u32()))


def read_channel(content: bytes) -> Channel:
    """Return a channel."""
    fields = Fields(content)
    number, schema = CHANNEL.unpack(fields.take(CHANNEL.size))
    return Channel(number, schema, fields.text(), fields.text(), fields.map())


def read_message(content: bytes) -> Message:
    """Return a message."""
    if len(content) < MESSAGE.size:
        raise MalformedRecordError("a message without its fields")
    channel, sequence, log_time_ns, publish_time_ns = MESSAGE.unpack_from(content)
    return Message(channel, sequence, log_time_ns, publish_time_ns, content[MESSAGE.size :])


def read_attachment(content: bytes, offset: int) -> AttachedFile:
    """Return an attachment; ``offset`` is the position of its content in the file."""
    fields = Fields(content)
    time_ns, _ = ATTACHMENT.unpack(fields.take(ATTACHMENT.size))
    name, media_type, size = fields.text(), fields.text(), fields.u64()
    begin = fields.at
    fields.take(size)
    checked = fields.at
    told = fields.u32()
    is_intact = not told or told == crc32(memoryview(content)[:checked])
    return AttachedFile(name, media_type, time_ns, offset + begin, size, is_intact)


def read_metadata(content: bytes) -> Metadata:
    """Return texts by name."""
    fields = Fields(content)
    return Metadata(fields.text(), fields.map())
