"""Reads an MCAP file record by record, however the file ends."""

from __future__ import annotations

import stat
from collections.abc import Callable, Iterator
from pathlib import Path
from zlib import crc32

from up.flight_log.compression import ZSTD, DecompressionError, decompressor
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
from up_flightlog.read.resync import LAST, MAX_LENGTH, MAX_RECORD, find_records, may_follow

MAX_FILE = 1 << 31
"""A file is indexed in memory; the recorder begins a new one long before."""
_HEAD = RECORD.size
_IN_CHUNKS = frozenset({Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE})
MAX_CHUNK = 128 * 1024 * 1024
"""Of its records, bytes."""
MAX_RATIO, ALWAYS_EXPANDED = 500, 64 * 1024 * 1024
"""The chunks of a file expand to that many times its size at most, or to that many bytes."""
_MAX_COMPRESSION = 64
Found = tuple[int, int, int]
"""Opcode, offset of the content, its length."""


class RecordScanner:
    """Yields (opcode, offset of the content in ``data``, its length).

    Records inside uncompressed chunks are yielded like all others; a chunk compressed by zstd is
    yielded itself, for `expand` and `records_of_chunk`. Unreadable parts are added to ``problems``;
    after the scan, ``is_complete`` is whether the file ended properly. Raises FlightLogError for a
    file that is not MCAP.
    """

    def __init__(self, data: bytes, problems: Problems) -> None:
        self.is_complete = False
        self._data = data
        self._problems = problems
        self._data_end = 0
        self._is_damaged = False
        self._expandable = max(ALWAYS_EXPANDED, MAX_RATIO * len(data))
        self._decompressor: Callable[[bytes, int], bytes] | None = None

    def __iter__(self) -> Iterator[Found]:
        if not self._data.startswith(MAGIC):
            code = "not_mcap" if self._data else "empty"
            why = "it does not begin with the MCAP magic" if self._data else "it is empty"
            raise FlightLogError(f"{self._problems.name}: not a flight log: {why}", code)
        data, size, at = self._data, len(self._data), len(MAGIC)
        while at + _HEAD <= size:
            opcode, length = RECORD.unpack_from(data, at)
            begin, end = at + _HEAD, at + _HEAD + length
            if self._is_broken(data, opcode, length, end, size):
                found = find_records(data, at + 1)
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

    @staticmethod
    def _is_broken(data: bytes, opcode: int, length: int, end: int, limit: int) -> bool:
        """Return whether no record can be here; a rare one must be followed by another."""
        if end > limit or opcode == 0:
            return True
        is_rare = opcode > LAST or length > MAX_LENGTH
        return is_rare and not may_follow(data[end : min(end + _HEAD, limit)], limit - end)

    def summary(self) -> Iterator[Found]:
        """Yield the records of the summary, if there is one that its checksum confirms."""
        data = self._data
        end = len(data) - len(MAGIC)
        at = end - FOOTER.size - _HEAD
        if at < 0 or not data.startswith(MAGIC, end):
            return
        begin, _, expected = FOOTER.unpack_from(data, at + _HEAD)
        if RECORD.unpack_from(data, at) != (Opcode.FOOTER, FOOTER.size) or not 0 < begin <= at:
            return
        if expected == crc32(memoryview(data)[begin : end - U32.size]):
            yield from self.records_of_chunk(data, begin, at)

    def expand(self, at: int) -> bytes:
        """Return the records of the compressed chunk whose content is there; empty if damaged."""
        data = self._data
        begin, size = _packed(data, at)
        length, expected = CHUNK.unpack_from(data, at)[2:]
        if length > MAX_CHUNK:
            limit = f"more than {MAX_CHUNK >> 20} MiB: make smaller ones with mcap's tools"
            text = f"a chunk of {length} bytes is skipped, {limit}"
            self._problems.add("chunk_skipped", text, at - _HEAD)
            return b""
        self._expandable -= length
        if self._expandable < 0:
            text = f"the chunks expand to more than {MAX_RATIO} times the file: the rest is skipped"
            self._problems.add("expansion_limit", text, at - _HEAD)
            return b""
        try:
            records = self._decompress(data[begin : begin + size], length)
        except DecompressionError as error:
            text = f"a chunk is damaged and skipped: {error}"
            self._problems.add("chunk_skipped", text, at - _HEAD)
            return b""
        self._check_chunk(expected, records, at - _HEAD)
        return records

    def records_of_chunk(
        self, data: bytes, at: int, limit: int, chunk: int | None = None
    ) -> Iterator[Found]:
        """Yield the records of a chunk between ``at`` and ``limit`` of ``data``.

        ``chunk`` is where the compressed chunk is, for problems; None: ``data`` are the file's.
        """
        unpack = RECORD.unpack_from
        while at + _HEAD <= limit:
            opcode, length = unpack(data, at)
            end = at + _HEAD + length
            if opcode in _IN_CHUNKS and length <= MAX_LENGTH and end <= limit:
                # Nearly all records.
                yield opcode, at + _HEAD, length
                at = end
                continue
            place = at if chunk is None else chunk
            if self._is_broken(data, opcode, length, end, limit):
                text = "a chunk is damaged; the rest of it is lost"
                self._problems.add("chunk_lost", text, place)
                return
            if opcode == Opcode.CHUNK:
                self._problems.add("nested_chunk", "a chunk inside a chunk is skipped", place)
            elif length > MAX_RECORD:
                text = f"a record of {length} bytes is skipped"
                self._problems.add("record_skipped", text, place)
            elif opcode in _IN_CHUNKS:
                yield opcode, at + _HEAD, length
            at = end

    def _chunk(self, at: int, end: int) -> Iterator[Found]:
        """Yield the records in the chunk with its content there, or a compressed chunk."""
        data, place = self._data, at - _HEAD
        begin = at + CHUNK.size + U32.size
        size = U32.unpack_from(data, at + CHUNK.size)[0] if begin <= end else _MAX_COMPRESSION + 1
        method = data[begin : begin + size].decode("ascii", "replace")
        is_whole = size <= _MAX_COMPRESSION and begin + size + U64.size <= end
        if is_whole and method not in ("", ZSTD):
            text = f"a chunk compressed by {method!a} is skipped: uncompress it with mcap's tools"
            self._problems.add("chunk_skipped", text, place)
            return
        begin, size = _packed(data, at) if is_whole else (end, 1)
        if begin + size > end:
            self._problems.add("chunk_skipped", "a chunk is damaged and skipped", place)
        elif method:
            yield Opcode.CHUNK, at, end - at
        else:
            limit = begin + size
            yield from self.records_of_chunk(data, begin, limit)
            self._check_chunk(CHUNK.unpack_from(data, at)[3], data[begin:limit], limit)

    def _check_chunk(self, expected: int, records: bytes, place: int) -> None:
        if expected and expected != crc32(records):
            text = "a chunk does not match its checksum: it is damaged"
            self._problems.add("chunk_checksum", text, place)

    def _decompress(self, data: bytes, size: int) -> bytes:
        if self._decompressor is None:
            self._decompressor = decompressor()
        if self._decompressor is None:
            text = (
                f"{self._problems.name}: zstandard is missing, which a compressed flight log needs:"
                " pip install zstandard, or Debian's package python3-zstandard"
            )
            raise FlightLogError(text, "no_zstandard")
        return self._decompressor(data, size)

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
        if self._data_end:
            return
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


def _packed(data: bytes, at: int) -> tuple[int, int]:
    """Return offset and size of the records of the chunk whose content is at ``at``."""
    size = at + CHUNK.size
    begin = size + U32.size + U32.unpack_from(data, size)[0] + U64.size
    return begin, U64.unpack_from(data, begin - U64.size)[0]


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
            # A growing recording is read up to its size at the start of the reading.
            return file.read(found.st_size)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FlightLogError(f"cannot read {path.name}: {reason}", "unreadable") from None
