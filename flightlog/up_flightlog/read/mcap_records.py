"""The records of MCAP that a log keeps, as values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from struct import Struct
from zlib import crc32

from up.flight_log.mcap_format import ATTACHMENT, CHANNEL, U16, U32, U64, Opcode
from up_flightlog.read.problems import Problems


class MalformedRecordError(ValueError):
    """The content of a record violates its layout; the text says how."""


@dataclass(frozen=True, slots=True)
class Schema:
    """The layout of a channel's messages."""

    id: int
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
class AttachedFile:
    """An attached file and the position of its ``size`` bytes."""

    name: str
    offset: int
    size: int


@dataclass(frozen=True, slots=True)
class Metadata:
    """Texts by name."""

    name: str
    values: Mapping[str, str]


Record = Schema | Channel | AttachedFile | Metadata


class Fields:
    """The fields of one record's content in order; MalformedRecordError if it is too short."""

    def __init__(self, content: bytes) -> None:
        self.at = 0
        self._content = content

    def number(self, kind: Struct) -> int:
        return kind.unpack(self.read(kind.size))[0]  # type: ignore[no-any-return]

    def text(self) -> str:
        try:
            return self.read(self.number(U32)).decode("utf-8")
        except UnicodeDecodeError:
            raise MalformedRecordError("a text that is not UTF-8") from None

    def map(self) -> dict[str, str]:
        end = self.number(U32) + self.at
        values: dict[str, str] = {}
        while self.at < end:
            name = self.text()
            values[name] = self.text()
        return values

    def read(self, size: int) -> bytes:
        begin, self.at = self.at, self.at + size
        if self.at > len(self._content):
            raise MalformedRecordError("a field that is longer than its record")
        return self._content[begin : self.at]


def read_record(opcode: int, offset: int, content: bytes, problems: Problems) -> Record | None:
    """Return a record; None for one of another kind, or a malformed one, which is a problem.

    ``offset`` is the position of its content in the file.
    """
    fields = Fields(content)
    try:
        if opcode == Opcode.SCHEMA:
            number, _name, _encoding = fields.number(U16), fields.text(), fields.text()
            return Schema(number, fields.read(fields.number(U32)))
        if opcode == Opcode.CHANNEL:
            number, schema = CHANNEL.unpack(fields.read(CHANNEL.size))
            return Channel(number, schema, fields.text(), fields.text(), fields.map())
        if opcode == Opcode.METADATA:
            return Metadata(fields.text(), fields.map())
        if opcode == Opcode.ATTACHMENT:
            return _attachment(fields, offset, content, problems)
    except MalformedRecordError as error:
        problems.add("malformed_record", f"a malformed record is skipped: {error}", offset)
    return None


def _attachment(fields: Fields, offset: int, content: bytes, problems: Problems) -> AttachedFile:
    fields.read(ATTACHMENT.size)
    name, _media_type, size = fields.text(), fields.text(), fields.number(U64)
    begin = fields.at
    fields.read(size)
    checked = fields.at
    checksum = fields.number(U32)
    if checksum and checksum != crc32(memoryview(content)[:checked]):
        text = "an attachment does not match its checksum: it is damaged"
        problems.add("attachment_checksum", text, offset)
    return AttachedFile(name, offset + begin, size)
