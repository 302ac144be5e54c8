"""The layout of MCAP, the container of the flight log (https://mcap.dev/spec, version 0)."""

from enum import IntEnum
from struct import Struct

from up.errors import UserError
from up.fields import printable

MAGIC = b"\x89MCAP0\r\n"
JSON = "json"
JSON_SCHEMA = "jsonschema"


class FlightLogError(UserError):
    """A flight log cannot be read or written; the text is one sentence that names the file."""

    def __init__(self, text: str, code: str) -> None:
        super().__init__(printable(text), code)


class Opcode(IntEnum):
    """The kind of a record."""

    HEADER = 0x01
    FOOTER = 0x02
    SCHEMA = 0x03
    CHANNEL = 0x04
    MESSAGE = 0x05
    CHUNK = 0x06
    MESSAGE_INDEX = 0x07
    CHUNK_INDEX = 0x08
    ATTACHMENT = 0x09
    ATTACHMENT_INDEX = 0x0A
    STATISTICS = 0x0B
    METADATA = 0x0C
    METADATA_INDEX = 0x0D
    SUMMARY_OFFSET = 0x0E
    DATA_END = 0x0F


RECORD = Struct("<BQ")
"""Opcode and length of the content that follows."""
MESSAGE = Struct("<HIQQ")
"""Channel, sequence, log time and publish time, ns; the data follow."""
MESSAGE_RECORD = Struct("<BQHIQQ")
"""A whole message record without its data."""
CHUNK = Struct("<QQQI")
"""First and last log time, ns, uncompressed size, CRC; compression and records follow."""
ATTACHMENT = Struct("<QQ")
"""Log time and creation time, ns; name, media type, data and CRC follow."""
ATTACHMENT_INDEX = Struct("<QQQQQ")
"""Offset, length, log time, creation time and data size; name and media type follow."""
STATISTICS = Struct("<QHIIIIQQ")
"""Messages, schemas, channels, attachments, metadata, chunks, first and last log time, ns."""
FOOTER = Struct("<QQI")
"""Start of the summary, start of its offsets, CRC of the summary."""
SUMMARY_OFFSET = Struct("<BQQ")
"""Opcode of a group of the summary, its start and its length."""
METADATA_INDEX = Struct("<QQ")
"""Offset and length; the name follows."""
CHANNEL = Struct("<HH")
"""Identifier of the channel and of its schema; topic, encoding and metadata follow."""
U16, U32, U64 = Struct("<H"), Struct("<I"), Struct("<Q")
COUNT = Struct("<HQ")
"""A channel and how many messages it has."""
