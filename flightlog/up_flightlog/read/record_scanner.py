"""Reads an MCAP file record by record, through one window, however the file ends."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO
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
from up_flightlog.read.resync import (
    CONFIRMATION_RECORDS,
    LAST,
    MAX_LENGTH,
    MAX_RECORD,
    find_messages,
    may_follow,
)

_WINDOW = 1024 * 1024
_ACROSS = CONFIRMATION_RECORDS * MAX_LENGTH
_HEAD = RECORD.size
_IN_CHUNKS = frozenset({Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE})
_MAX_COMPRESSION = 64
MAX_HEAD = CHUNK.size + U32.size + _MAX_COMPRESSION + U64.size


def fault_of_chunk(head: bytes, length: int) -> tuple[str, int]:
    """Return why a chunk cannot be scanned, and where in its content the records begin."""
    damaged = "a chunk is damaged and skipped"
    at = CHUNK.size + U32.size
    if len(head) < at:
        return damaged, 0
    (size,) = U32.unpack_from(head, CHUNK.size)
    begin = at + size + U64.size
    if size > _MAX_COMPRESSION or len(head) < begin:
        return damaged, 0
    if size:
        method = head[at : at + size].decode("ascii", "replace")
        return f"a chunk compressed by {method!a} is skipped: uncompress it with mcap's tools", 0
    if begin + U64.unpack_from(head, at)[0] > length:
        return damaged, 0
    return "", begin


class Checksum:
    """A CRC over the file from one position on; ``end`` is its progress."""

    def __init__(self, begin: int) -> None:
        self.value = 0
        self.begin = begin
        self.end = begin

    def update(self, buffer: bytes, base: int, until: int) -> None:
        """Continue to that byte of the file; ``buffer`` holds the bytes from ``base`` on."""
        if until > self.end:
            self.value = crc32(memoryview(buffer)[self.end - base : until - base], self.value)
            self.end = until


class RecordScanner:
    """Yields (opcode, offset of the content in the file, its start in ``buffer``, its length).

    The content is ``buffer[start:start + length]``, valid until the next step. Records inside
    uncompressed chunks are yielded like all others. Unreadable parts are added to ``problems``;
    after the scan, ``is_complete`` is whether the file ended properly. Raises FlightLogError for a
    file that is not MCAP or cannot be read.
    """

    def __init__(self, file: BinaryIO, problems: Problems) -> None:
        self.buffer = b""
        self.is_complete = False
        self._file = file
        self._problems = problems
        self._name = problems.name
        self._size = os.fstat(file.fileno()).st_size
        self._base = 0
        self._pos = 0
        self._data_sum = Checksum(0)
        self._chunk_sum: Checksum | None = None
        self._summary_sum: Checksum | None = None
        self._limit = self._size
        self._chunk_end = 0
        self._is_damaged = False
        self._chunk_crc = 0

    def __iter__(self) -> Iterator[tuple[int, int, int, int]]:
        if not self._has(len(MAGIC)) or not self.buffer.startswith(MAGIC):
            code = "not_mcap" if self.buffer else "empty"
            why = "it does not begin with the MCAP magic" if self.buffer else "it is empty"
            raise FlightLogError(f"{self._name}: not a flight log: {why}", code)
        self._pos = len(MAGIC)
        while True:
            place = self._base + self._pos
            if self._chunk_sum is not None and place + _HEAD > self._limit:
                self._leave_chunk()
                continue
            if not self._has(_HEAD):
                self._note_end(place)
                return
            opcode, length = RECORD.unpack_from(self.buffer, self._pos)
            end = place + _HEAD + length
            if (
                end > self._limit
                or opcode == 0
                or ((opcode > LAST or length > MAX_LENGTH) and not self._may_continue(end))
            ):
                if self._chunk_sum is not None:
                    self._problems.add(
                        "chunk_lost", "a chunk is damaged; the rest of it is lost", place
                    )
                    self._chunk_crc = 0
                    self._seek(self._limit)
                    continue
                if not self._resynchronize(place):
                    self._note_broken(opcode, length, place)
                    return
                continue
            if opcode == Opcode.CHUNK:
                self._enter_chunk(place, length)
                continue
            if self._chunk_sum is not None and opcode not in _IN_CHUNKS:
                self._seek(end)
                continue
            if length > MAX_RECORD:
                self._problems.add(
                    "record_skipped", f"a record of {length} bytes is skipped", place
                )
                self._seek(end)
                continue
            if not self._has(_HEAD + length):
                raise FlightLogError(
                    f"{self._name}: it became shorter during the reading", "truncated"
                )
            start = self._pos + _HEAD
            yield opcode, place + _HEAD, start, length
            if opcode == Opcode.FOOTER:
                self._end(place, length)
                return
            self._pos = start + length
            if opcode == Opcode.DATA_END:
                self._end_data(place, length)

    def _may_continue(self, place: int) -> bool:
        """Return whether a record may follow; called only after an unexpected one."""
        try:
            head = os.pread(self._file.fileno(), min(_HEAD, self._limit - place), place)
        except OSError as error:
            raise self._unreadable(error, place) from None
        return may_follow(head, self._limit - place)

    def _unreadable(self, error: OSError, place: int) -> FlightLogError:
        why = error.strerror or error
        return FlightLogError(f"cannot read {self._name} at byte {place}: {why}", "unreadable")

    def _truncated(self) -> FlightLogError:
        return FlightLogError(f"{self._name}: it became shorter while it was read", "truncated")

    def _note_end(self, place: int) -> None:
        left = self._size - place
        lost = f", and {_bytes(left)} of a last record are lost" if left else ""
        text = f"the recording was cut off: it has no end{lost}"
        self._problems.add("cut_off", text, place)

    def _note_broken(self, opcode: int, length: int, place: int) -> None:
        left = self._size - place
        if opcode == 0:
            code, what = (
                "no_records",
                f"no more records, {_bytes(left)} are lost: cut off or damaged",
            )
        elif length > MAX_RECORD and opcode != Opcode.CHUNK:
            code, what = "bad_length", f"a record claims {length} bytes: {_bytes(left)} are lost"
        else:
            code = "cut_off"
            what = f"the recording was cut off: {_bytes(left)} of a last record are lost"
        self._problems.add(code, what, place)

    def _resynchronize(self, place: int) -> bool:
        """Continue after a damaged position, where whole records follow again; False if none do."""
        self._seek(place + 1)
        while (found := find_messages(self.buffer, self._pos)) < 0:
            if self._base + len(self.buffer) >= self._size:
                return False
            # The next window begins before the end of this one: a run may cross the boundary.
            at = self._base + max(self._pos + 1, len(self.buffer) - _ACROSS)
            self._seek(at)
            self._has(min(_WINDOW, self._size - at))
        self._pos = found
        self._problems.add("damaged_region", "a damaged region is skipped", place)
        self._is_damaged = True
        return True

    def _enter_chunk(self, place: int, length: int) -> None:
        end = place + _HEAD + length
        if self._chunk_sum is not None:
            self._problems.add("nested_chunk", "a chunk inside a chunk is skipped", place)
            self._seek(end)
            return
        self._has(min(_HEAD + length, _HEAD + MAX_HEAD))
        at = self._pos + _HEAD
        head = self.buffer[at : at + min(length, MAX_HEAD)]
        fault, begin = fault_of_chunk(head, length)
        if fault:
            self._problems.add("chunk_skipped", fault, place)
            self._seek(end)
            return
        self._chunk_end = end
        self._chunk_crc = CHUNK.unpack_from(head)[3]
        begin += place + _HEAD
        self._limit = begin + U64.unpack_from(head, begin - place - _HEAD - U64.size)[0]
        self._chunk_sum = Checksum(begin)
        self._seek(begin)

    def _leave_chunk(self) -> None:
        place, self._limit = self._limit, self._size
        self._seek(place)
        assert self._chunk_sum is not None
        self._chunk_sum.update(self.buffer, self._base, place)
        if self._chunk_crc and self._chunk_crc != self._chunk_sum.value:
            text = "a chunk does not match its checksum: it is damaged"
            self._problems.add("chunk_checksum", text, place)
        self._chunk_sum = None
        self._seek(self._chunk_end)

    def _end_data(self, place: int, length: int) -> None:
        self._data_sum.update(self.buffer, self._base, place)
        self._summary_sum = Checksum(self._base + self._pos)
        if length < U32.size:
            return
        (expected,) = U32.unpack_from(self.buffer, self._pos - length)
        if expected and expected != self._data_sum.value and not self._is_damaged:
            text = "the data do not match their checksum: something is damaged"
            self._problems.add("data_checksum", text, place)

    def _end(self, place: int, length: int) -> None:
        whole = _HEAD + FOOTER.size
        if length != FOOTER.size or not self._has(whole + len(MAGIC)):
            self._note_end(place)
            return
        summary, _, expected = FOOTER.unpack_from(self.buffer, self._pos + _HEAD)
        checked = self._summary_sum
        if expected and checked is not None and checked.end <= place and checked.begin == summary:
            checked.update(self.buffer, self._base, place + whole - U32.size)
            if checked.value != expected:
                text = "the summary does not match its checksum"
                self._problems.add("summary_checksum", text, place)
        self.is_complete = self.buffer.startswith(MAGIC, self._pos + whole)
        if not self.is_complete:
            self._note_end(place)

    def _has(self, needed: int) -> bool:
        """Return whether this many bytes follow, and load them into the window."""
        if len(self.buffer) - self._pos >= needed:
            return True
        place = self._base + self._pos
        for each in (self._data_sum, self._chunk_sum, self._summary_sum):
            if each is not None:
                each.update(self.buffer, self._base, place)
        rest = self.buffer[self._pos :]
        # A recording that goes on is read as far as it was when the scan began.
        left = max(0, self._size - place - len(rest))
        try:
            self.buffer = rest + self._file.read(min(left, max(_WINDOW, needed - len(rest))))
        except OSError as error:
            raise self._unreadable(error, place) from None
        self._base, self._pos = place, 0
        return len(self.buffer) >= needed

    def _seek(self, place: int) -> None:
        """Continue at that byte of the file, reading all bytes between for the checksums."""
        while place - self._base > len(self.buffer):
            self._pos = len(self.buffer)
            if not self._has(1):
                raise FlightLogError(
                    f"{self._name}: it became shorter during the reading", "truncated"
                )
        self._pos = place - self._base


def _bytes(count: int) -> str:
    return "1 byte" if count == 1 else f"{count} bytes"


def open_log(path: Path) -> BinaryIO:
    """Open a file for a scan; raises FlightLogError."""
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise FlightLogError(f"{path.name}: not a flight log: not a file", "not_a_file")
        return path.open("rb")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FlightLogError(f"cannot open {path.name}: {reason}", "unreadable") from None
