"""Writes MCAP: whole records or chunks, one write each, so that a file may end anywhere."""

import json
import struct
from collections.abc import Callable, Mapping
from typing import Any
from zlib import crc32

from up.flight_log.compression import ZSTD, Compress
from up.flight_log.mcap_format import (
    ATTACHMENT,
    ATTACHMENT_INDEX,
    CHANNEL,
    CHUNK,
    COUNT,
    FOOTER,
    JSON,
    JSON_SCHEMA,
    MAGIC,
    MESSAGE,
    MESSAGE_RECORD,
    METADATA_INDEX,
    RECORD,
    STATISTICS,
    SUMMARY_OFFSET,
    U16,
    U32,
    U64,
    Opcode,
)
from up.version import VERSION

LIBRARY = f"raspilot {VERSION}"
MAX_IDS = 65535
_SEQUENCES = 2**32
_MESSAGE = int(Opcode.MESSAGE)
_CONTENT = MESSAGE.size


class McapWriter:
    """Writes the records of one file: everything written is readable at any time.

    ``write`` takes the bytes of a whole record (`start` and `finish`: of several) and keeps all or
    raises; its exception passes through, and the record does not count. ``size`` is the length of
    the whole records: after truncating a torn file to it, writing may continue. With ``compress``
    (zstd) messages wait until `end_chunk` or `finish` writes them together; schemas and channels
    stay outside, so that a damaged chunk costs its own messages only. Times are nanoseconds since
    1970. Topics are JSON with a JSON Schema. Source: https://mcap.dev/spec.
    """

    def __init__(
        self,
        write: Callable[[bytes], object],
        compress: Compress | None = None,
    ) -> None:
        self.size = 0
        self.messages = 0
        self._write = write
        self._compress = compress
        self._chunk: list[bytes] = []
        self._chunk_times_ns: list[int] = []
        self._chunks = 0
        self._header = _text("") + _text(LIBRARY)
        self._crc = 0
        self._first_ns = 0
        self._last_ns = 0
        self._counts: dict[int, int] = {}
        self._schemas: list[bytes] = []
        self._channels: list[bytes] = []
        self._attachments: list[bytes] = []
        self._metadata: list[bytes] = []

    def start(self) -> None:
        self._put(MAGIC + _record(Opcode.HEADER, self._header))

    def add_schema(self, name: str, schema: Mapping[str, Any]) -> int:
        """Write a JSON Schema and return its identifier; ValueError if there are too many."""
        number = _next(len(self._schemas), "schemas")
        text = json.dumps(schema, allow_nan=False, separators=(",", ":")).encode()
        content = U16.pack(number) + _text(name) + _text(JSON_SCHEMA) + U32.pack(len(text)) + text
        record = _record(Opcode.SCHEMA, content)
        self._put(record)
        self._schemas.append(record)
        return number

    def add_channel(self, topic: str, schema_id: int) -> int:
        """Write a channel and return its identifier.

        ``schema_id`` 0: without a schema. ValueError for an unknown schema, or too many channels.
        """
        if not 0 <= schema_id <= len(self._schemas):
            raise ValueError(f"unknown schema {schema_id} of {topic}")
        number = _next(len(self._channels), "channels")
        content = CHANNEL.pack(number, schema_id) + _text(topic) + _text(JSON)
        record = _record(Opcode.CHANNEL, content + _map({}))
        self._put(record)
        self._channels.append(record)
        self._counts[number] = 0
        return number

    def message(self, channel_id: int, log_time_ns: int, data: bytes) -> None:
        """Write a message; ValueError for an unknown channel, or a time that MCAP cannot hold."""
        try:
            count = self._counts[channel_id]
            record = (
                MESSAGE_RECORD.pack(
                    _MESSAGE,
                    _CONTENT + len(data),
                    channel_id,
                    count % _SEQUENCES,
                    log_time_ns,
                    log_time_ns,
                )
                + data
            )
        except (KeyError, struct.error):
            raise ValueError(
                f"cannot write a message: channel {channel_id} is unknown or {log_time_ns} ns is"
                " out of range"
            ) from None
        if self._compress is None:
            self._write(record)
            self.size += len(record)
            self._crc = crc32(record, self._crc)
        else:
            self._chunk.append(record)
            self._chunk_times_ns.append(log_time_ns)
        self._counts[channel_id] = count + 1
        if not self.messages:
            self._first_ns = self._last_ns = log_time_ns
        elif log_time_ns > self._last_ns:
            self._last_ns = log_time_ns
        elif log_time_ns < self._first_ns:
            self._first_ns = log_time_ns
        self.messages += 1

    def end_chunk(self) -> int:
        """Write what waits as one compressed chunk; return the number of its messages."""
        if self._compress is None or not self._chunk:
            return 0
        records, times_ns = b"".join(self._chunk), self._chunk_times_ns
        self._chunk, self._chunk_times_ns = [], []
        head = CHUNK.pack(min(times_ns), max(times_ns), len(records), crc32(records))
        packed = self._compress(records)
        content = head + _text(ZSTD) + U64.pack(len(packed)) + packed
        self._put(_record(Opcode.CHUNK, content))
        self._chunks += 1
        return len(times_ns)

    def add_metadata(self, name: str, values: Mapping[str, str]) -> None:
        record = _record(Opcode.METADATA, _text(name) + _map(values))
        index = METADATA_INDEX.pack(self.size, len(record)) + _text(name)
        self._put(record)
        self._metadata.append(_record(Opcode.METADATA_INDEX, index))

    def add_attachment(self, name: str, media_type: str, data: bytes, log_time_ns: int) -> None:
        """Write an attached file; ValueError for a time that MCAP cannot hold."""
        if not 0 <= log_time_ns < 2**64:
            raise ValueError(f"cannot attach {name}: {log_time_ns} ns is out of range")
        times, names = ATTACHMENT.pack(log_time_ns, 0), _text(name) + _text(media_type)
        content = times + names + U64.pack(len(data)) + data
        record = _record(Opcode.ATTACHMENT, content + U32.pack(crc32(content)))
        place = ATTACHMENT_INDEX.pack(self.size, len(record), log_time_ns, 0, len(data))
        self._put(record)
        self._attachments.append(_record(Opcode.ATTACHMENT_INDEX, place + names))

    def finish(self) -> None:
        """Write the end of the data, the summary with statistics, the footer and the magic."""
        self.end_chunk()
        end = _record(Opcode.DATA_END, U32.pack(self._crc))
        start = self.size + len(end)
        summary, offsets = bytearray(), bytearray()
        for opcode, records in (
            (Opcode.SCHEMA, self._schemas),
            (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [_record(Opcode.STATISTICS, self._statistics())]),
            (Opcode.ATTACHMENT_INDEX, self._attachments),
            (Opcode.METADATA_INDEX, self._metadata),
        ):
            group = b"".join(records)
            if group:
                place = SUMMARY_OFFSET.pack(opcode, start + len(summary), len(group))
                offsets += _record(Opcode.SUMMARY_OFFSET, place)
                summary += group
        footer = _record(Opcode.FOOTER, FOOTER.pack(start, start + len(summary), 0))[: -U32.size]
        checked = bytes(summary + offsets + footer)
        self._put(end + checked + U32.pack(crc32(checked)) + MAGIC)

    def _statistics(self) -> bytes:
        schemas, channels = len(self._schemas), len(self._channels)
        attachments, metadata = len(self._attachments), len(self._metadata)
        head = STATISTICS.pack(
            *(self.messages, schemas, channels, attachments, metadata, self._chunks),
            *(self._first_ns, self._last_ns),
        )
        counts = b"".join(COUNT.pack(*each) for each in self._counts.items())
        return head + U32.pack(len(counts)) + counts

    def _put(self, record: bytes) -> None:
        self._write(record)
        self.size += len(record)
        self._crc = crc32(record, self._crc)


def _next(count: int, what: str) -> int:
    if count >= MAX_IDS:
        raise ValueError(f"a flight log has {MAX_IDS} {what} at most")
    return count + 1


def _record(opcode: Opcode, content: bytes) -> bytes:
    return RECORD.pack(opcode, len(content)) + content


def _text(text: str) -> bytes:
    # A lone surrogate (a file name, a peer's text) must not end the recording.
    data = text.encode("utf-8", "replace")
    return U32.pack(len(data)) + data


def _map(values: Mapping[str, str]) -> bytes:
    data = b"".join(_text(each) for item in values.items() for each in item)
    return U32.pack(len(data)) + data
