"""Reads MCAP record by record, as far as a damaged file permits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from up.flight_log.mcap_format import Opcode
from up.flight_log.mcap_records import (
    AttachedFile,
    Channel,
    Header,
    MalformedRecordError,
    Message,
    Metadata,
    Schema,
    read_attachment,
    read_channel,
    read_header,
    read_message,
    read_metadata,
    read_schema,
)
from up.flight_log.problems import Problems
from up.flight_log.record_walk import RecordWalk, open_log

Record = Header | Schema | Channel | Message | AttachedFile | Metadata
_KINDS: dict[int, Callable[[bytes], Record]] = {
    Opcode.HEADER: read_header,
    Opcode.SCHEMA: read_schema,
    Opcode.CHANNEL: read_channel,
    Opcode.MESSAGE: read_message,
    Opcode.METADATA: read_metadata,
}


def read_records(path: Path, problems: list[str] | None = None) -> Iterator[Record]:
    """Yield the records of a file in their order, those of its summary last.

    A truncated file yields all records before the cut; losses, damage and skipped parts are added
    to ``problems`` as sentences at the end. Holds only one record in memory. Raises FlightLogError
    for a file that is not MCAP or cannot be read.
    """
    noted = Problems(path.name)
    with open_log(path) as file:
        walk = RecordWalk(file, noted)
        try:
            for opcode, offset, start, length in walk:
                record = read_record(opcode, offset, walk.buffer[start : start + length], noted)
                if record is not None:
                    yield record
        finally:
            if problems is not None:
                problems.extend(noted.sentences)


def read_record(opcode: int, offset: int, content: bytes, problems: Problems) -> Record | None:
    """Return a record; None for an index record, or a malformed one, which is noted."""
    try:
        if opcode == Opcode.ATTACHMENT:
            attached = read_attachment(content, offset)
            if not attached.is_intact:
                problems.note("an attachment does not match its checksum: it is damaged", offset)
            return attached
        read = _KINDS.get(opcode)
        return None if read is None else read(content)
    except MalformedRecordError as error:
        problems.note(f"a malformed record is left out: {error}", offset)
        return None
