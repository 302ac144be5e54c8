"""Reads an MCAP file record by record, however the file ends."""

from __future__ import annotations

import stat
from collections.abc import Iterator
from pathlib import Path
from zlib import crc32

from up.flight_log.mcap_format import (
    CHUNK,
    FOOTER,
    MAGIC,
    RECORD,
    U32,
    U64,
    FlightLogError,
    Opcode,
)
from up_flightlog.read.problems import Problems
from up_flightlog.read.resync import LAST, MAX_LENGTH, MAX_RECORD, find_messages, may_follow

MAX_FILE = 1 << 31
"""A file is indexed in memory; the recorder begins a new one long before."""
_HEAD = RECORD.size
_IN_CHUNKS = frozenset({Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE})
_MAX_COMPRESSION = 64
Found = tuple[int, int, int]
"""Opcode, offset of the content, its length."""


class RecordScanner:
    """Yields (opcode, offset of the content in ``data``, its length).

    Records inside uncompressed chunks are yielded like all others. Unreadable parts are added to
    ``problems``; after the scan, ``is_complete`` is whether the file ended properly. Raises
    FlightLogError for a file that is not MCAP.
    """

    def __init__(self, data: bytes, problems: Problems) -> None:
        self.is_complete = False
        self._data = data
        self._problems = problems
        self._data_end = 0
        self._is_damaged = False

    def __iter__(self) -> Iterator[Found]:
        if not self._data.startswith(MAGIC):
            code = "not_mcap" if self._data else "empty"
            why = "it does not begin with the MCAP magic" if self._data else "it is empty"
            raise FlightLogError(f"{self._problems.name}: not a flight log: {why}", code)
        data, size, at = self._data, len(self._data), len(MAGIC)
        while at + _HEAD <= size:
            opcode, length = RECORD.unpack_from(data, at)
            begin, end = at + _HEAD, at + _HEAD + length
            if self._is_broken(opcode, length, end, size):
                found = find_messages(data, at + 1)
                if found < 0:
                    self._note_broken(opcode, length, at)
                    return
                self._problems.add("damaged_region", "a damaged region is skipped", at)
                self._is_damaged = True
                at = found
                continue
            if opcode == Opcode.CHUNK:
                yield from self._chunk(begin, end)
            elif length > MAX_RECORD:
                self._problems.add("record_skipped", f"a record of {length} bytes is skipped", at)
            else:
                yield opcode, begin, length
            if opcode == Opcode.FOOTER:
                self._end(begin, length)
                return
            if opcode == Opcode.DATA_END:
                self._end_data(at, end)
            at = end
        self._note_end(at)

    def _is_broken(self, opcode: int, length: int, end: int, limit: int) -> bool:
        """Return whether no record can be here; a rare one must be followed by another."""
        if end > limit or opcode == 0:
            return True
        is_rare = opcode > LAST or length > MAX_LENGTH
        return is_rare and not may_follow(self._data[end : min(end + _HEAD, limit)], limit - end)

    def _chunk(self, at: int, end: int) -> Iterator[Found]:
        """Yield the records in the chunk with its content there."""
        data, place = self._data, at - _HEAD
        begin = at + CHUNK.size + U32.size
        size = U32.unpack_from(data, at + CHUNK.size)[0] if begin <= end else _MAX_COMPRESSION + 1
        method = data[begin : begin + size].decode("ascii", "replace")
        begin += size + U64.size
        is_whole = size <= _MAX_COMPRESSION and begin <= end
        if is_whole and method:
            text = f"a chunk compressed by {method!a} is skipped: uncompress it with mcap's tools"
            self._problems.add("chunk_skipped", text, place)
            return
        limit = begin + U64.unpack_from(data, begin - U64.size)[0] if is_whole else end + 1
        if limit > end:
            self._problems.add("chunk_skipped", "a chunk is damaged and skipped", place)
            return
        yield from self._records_of_chunk(begin, limit)
        expected = CHUNK.unpack_from(data, at)[3]
        if expected and expected != crc32(memoryview(data)[begin:limit]):
            text = "a chunk does not match its checksum: it is damaged"
            self._problems.add("chunk_checksum", text, limit)

    def _records_of_chunk(self, at: int, limit: int) -> Iterator[Found]:
        while at + _HEAD <= limit:
            opcode, length = RECORD.unpack_from(self._data, at)
            end = at + _HEAD + length
            if self._is_broken(opcode, length, end, limit):
                text = "a chunk is damaged; the rest of it is lost"
                self._problems.add("chunk_lost", text, at)
                return
            if opcode == Opcode.CHUNK:
                self._problems.add("nested_chunk", "a chunk inside a chunk is skipped", at)
            elif length > MAX_RECORD:
                self._problems.add("record_skipped", f"a record of {length} bytes is skipped", at)
            elif opcode in _IN_CHUNKS:
                yield opcode, at + _HEAD, length
            at = end

    def _note_end(self, place: int) -> None:
        left = len(self._data) - place
        lost = f", and {_bytes(left)} of a last record are lost" if left else ""
        text = f"the recording was cut off: it has no end{lost}"
        self._problems.add("cut_off", text, place)

    def _note_broken(self, opcode: int, length: int, place: int) -> None:
        left = _bytes(len(self._data) - place)
        if opcode == 0:
            code, what = "no_records", f"no more records, {left} are lost: cut off or damaged"
        elif length > MAX_RECORD and opcode != Opcode.CHUNK:
            code, what = "bad_length", f"a record claims {length} bytes: {left} are lost"
        else:
            code, what = "cut_off", f"the recording was cut off: {left} of a last record are lost"
        self._problems.add(code, what, place)

    def _end_data(self, place: int, end: int) -> None:
        self._data_end = end
        if end - place < _HEAD + U32.size:
            return
        (expected,) = U32.unpack_from(self._data, place + _HEAD)
        if expected and not self._is_damaged and expected != crc32(memoryview(self._data)[:place]):
            text = "the data do not match their checksum: something is damaged"
            self._problems.add("data_checksum", text, place)

    def _end(self, begin: int, length: int) -> None:
        if length == FOOTER.size:
            end = begin + length
            summary, _, expected = FOOTER.unpack_from(self._data, begin)
            checked = memoryview(self._data)[summary : end - U32.size]
            if expected and summary == self._data_end and crc32(checked) != expected:
                text = "the summary does not match its checksum"
                self._problems.add("summary_checksum", text, begin - _HEAD)
            self.is_complete = self._data.startswith(MAGIC, end)
        if not self.is_complete:
            self._note_end(begin - _HEAD)


def _bytes(count: int) -> str:
    return "1 byte" if count == 1 else f"{count} bytes"


def read_file(path: Path) -> bytes:
    """Return the content of a log; raises FlightLogError."""
    try:
        found = path.stat()
        if not stat.S_ISREG(found.st_mode):
            raise FlightLogError(f"{path.name}: not a flight log: not a file", "not_a_file")
        if found.st_size > MAX_FILE:
            text = f"{path.name}: more than {MAX_FILE >> 30} GiB: split it with mcap's tools"
            raise FlightLogError(text, "too_large")
        with path.open("rb") as file:
            # A recording that goes on is read as far as it was when the reading began.
            return file.read(found.st_size)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FlightLogError(f"cannot read {path.name}: {reason}", "unreadable") from None
