"""The topics of a log from the summary at the end of its files, without reading the rest."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from zlib import crc32

from up.flight_log.mcap_format import FOOTER, MAGIC, RECORD, U32, Opcode
from up_flightlog.read.log_parts import MAX_KEPT_BYTES
from up_flightlog.read.mcap_records import Channel, read_record
from up_flightlog.read.problems import Problems

_END = RECORD.size + FOOTER.size + len(MAGIC)


def summary_topics(paths: Iterable[Path]) -> set[str] | None:
    """Return the topics of a flight; None if a file has no intact summary: it has to be read."""
    topics: set[str] = set()
    for path in paths:
        summary = _summary(path)
        if summary is None:
            return None
        problems, at = Problems(path.name), 0
        while at + RECORD.size <= len(summary):
            opcode, length = RECORD.unpack_from(summary, at)
            at += RECORD.size
            if opcode == Opcode.CHANNEL:
                channel = read_record(opcode, at, summary[at : at + length], problems)
                if not isinstance(channel, Channel):
                    return None
                topics.add(channel.topic)
            at += length
    return topics


def _summary(path: Path) -> bytes | None:
    """Return the records of the summary; None without one that matches its checksum."""
    try:
        with path.open("rb") as file:
            size = path.stat().st_size
            file.seek(max(0, size - _END))
            end = file.read(_END)
            if len(end) < _END or not end.endswith(MAGIC) or end[0] != Opcode.FOOTER:
                return None
            start, _, expected = FOOTER.unpack_from(end, RECORD.size)
            length = size - _END - start
            if not start or not 0 < length <= MAX_KEPT_BYTES:
                return None
            file.seek(start)
            summary = file.read(length)
    except OSError:
        return None
    checked = crc32(end[: RECORD.size + FOOTER.size - U32.size], crc32(summary))
    return summary if expected == checked else None
