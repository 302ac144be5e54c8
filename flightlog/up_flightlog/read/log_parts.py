"""One part of a flight's log: indexes its messages and keeps the data to decode them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from struct import Struct

from up.fields import printable
from up.flight_log.mcap_format import JSON, MESSAGE, FlightLogError, Opcode
from up_flightlog.read.expanded_records import ExpandedRecords
from up_flightlog.read.log_files import LogFiles, is_being_recorded
from up_flightlog.read.log_index import EXPANDED, LogIndex
from up_flightlog.read.mcap_records import AttachedFile, Channel, Metadata, Schema, read_record
from up_flightlog.read.problems import LogProblem, Problems
from up_flightlog.read.record_scanner import Found, RecordScanner, read_file

MAX_ATTACHMENTS = 1000
MAX_METADATA = 1000
MAX_KEPT_BYTES = 32 * 1024 * 1024
"""Of schemas, channels and metadata together."""
_MESSAGE_HEAD = Struct("<HIQ")
_MESSAGE, _CHUNK = int(Opcode.MESSAGE), int(Opcode.CHUNK)
_KEPT = frozenset({Opcode.SCHEMA, Opcode.CHANNEL, Opcode.METADATA, Opcode.ATTACHMENT})


@dataclass(frozen=True, slots=True)
class Attachment:
    """A file attached to the flight, read on demand."""

    size: int
    path: Path
    offset: int

    def read(self) -> bytes:
        """Return its content; raises FlightLogError."""
        with LogFiles([self.path]) as files:
            return files.read(0, self.offset, self.size)


class TopicInfo:
    """The metadata of a topic, and its messages that could not be read."""

    def __init__(self, encoding: str, schema: Schema | None) -> None:
        self.schema = schema
        self.is_json = encoding == JSON
        self._encoding = encoding
        self._unread = 0
        self._reason = ""
        self._last = -1

    def add_unread(self, position: int, reason: str) -> None:
        """Count a message that could not be read; repeated reports count once."""
        if position > self._last:
            self._last = position
            self._unread += 1
            self._reason = self._reason or reason

    def problems(self, topic: str) -> list[LogProblem]:
        topic = printable(topic)
        if not self.is_json:
            text = f"{topic}: the encoding {self._encoding!a:.40} is not JSON: it is only listed"
            return [LogProblem("not_json", text)]
        if self._unread:
            plural = "" if self._unread == 1 else "s"
            text = f"{topic}: {self._unread} message{plural} skipped: {self._reason}"
            return [LogProblem("messages_skipped", text)]
        return []


class PartReader:
    """Reads one file into an index; ``fault`` is the reason if the whole file is unreadable."""

    def __init__(self, path: Path, number: int) -> None:
        self.path = path
        self.fault: FlightLogError | None = None
        self.is_complete = False
        self.is_recording = False
        self.metadata: dict[str, dict[str, str]] = {}
        self.attachments: dict[str, Attachment] = {}
        self.topics: dict[str, TopicInfo] = {}
        self._number = number
        self._problems = Problems(path.name)
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._kept = 0
        self._outliers: list[LogProblem] = []

    @property
    def problems(self) -> list[LogProblem]:
        fault = [] if self.fault is None else [LogProblem(self.fault.code, str(self.fault))]
        return [*fault, *self._problems.all(), *self._outliers]

    def report_outliers(self, count: int) -> None:
        plural = "" if count == 1 else "s"
        text = f"{self.path.name}: {count} message{plural} with an impossible time skipped"
        self._outliers = [LogProblem("timestamp_outliers", text)]

    def read(self, index: LogIndex, expanded: ExpandedRecords) -> None:
        """Add the messages of the file to the index, as far as they are readable."""
        try:
            data = read_file(self.path)
            scanner = RecordScanner(data, self._problems)
            # Topic numbers by channel: the only lookup per message.
            topics: dict[int, int | None] = {}
            # A damaged head costs no channel: a file that ended properly has them twice.
            for opcode, offset, length in scanner.summary():
                content = data[offset : offset + length]
                self._keep(opcode, offset, content, index.topic, topics)
            add = index.adder(self._number)
            for at in self._read(scanner, data, add, index, topics):
                records = scanner.expand(at)
                found = [*scanner.records_of_chunk(records, 0, len(records), at)]
                add_expanded = index.adder(self._number, EXPANDED + expanded.size)
                if found:
                    expanded.append(records)
                # Yields nothing: there are no chunks inside chunks.
                list(self._read(found, records, add_expanded, index, topics, at))
            self.is_complete = scanner.is_complete
            if not self.is_complete and is_being_recorded(self.path):
                self.is_recording = True
                self._problems.forget("cut_off")
        except FlightLogError as error:
            self.fault = error

    def _read(
        self,
        records: Iterable[Found],
        data: bytes,
        add: Callable[[int, int, int, int], None],
        index: LogIndex,
        topics: dict[int, int | None],
        chunk: int | None = None,
    ) -> Iterator[int]:
        """Take records of ``data``; yield where the content of each compressed chunk is.

        ``chunk`` is where the chunk of ``data`` is, for problems; None: ``data`` are the file's.
        """
        unpack, size = _MESSAGE_HEAD.unpack_from, MESSAGE.size
        for opcode, offset, length in records:
            place = offset if chunk is None else chunk
            if opcode == _MESSAGE:
                if length < size:
                    self._problems.add("short_message", "a message without its fields", place)
                    continue
                channel, _, time_ns = unpack(data, offset)
                topic = topics.get(channel)
                if topic is None:
                    self._problems.add("unknown_channel", "a message of an unknown channel", place)
                    continue
                add(topic, time_ns, offset + size, length - size)
            elif opcode in _KEPT:
                content = data[offset : offset + length]
                self._keep(opcode, place, content, index.topic, topics)
            elif opcode == _CHUNK:
                yield offset

    def _keep(
        self,
        opcode: int,
        offset: int,
        content: bytes,
        number_of: Callable[[str], int | None],
        topics: dict[int, int | None],
    ) -> None:
        record = read_record(opcode, offset, content, self._problems)
        if isinstance(record, AttachedFile):
            self._attach(record)
            return
        self._kept += len(content)
        if self._kept > MAX_KEPT_BYTES:
            text = "too many schemas, channels or metadata: the rest is skipped"
            self._problems.add("too_much_metadata", text, offset)
        elif isinstance(record, Schema):
            self._schemas.setdefault(record.id, record)
        elif isinstance(record, Channel):
            self._declare(record, offset, number_of, topics)
        elif isinstance(record, Metadata) and len(self.metadata) < MAX_METADATA:
            self.metadata.setdefault(record.name, dict(record.values))

    def _declare(
        self,
        channel: Channel,
        offset: int,
        number_of: Callable[[str], int | None],
        topics: dict[int, int | None],
    ) -> None:
        known = self._channels.setdefault(channel.id, channel)
        if known is not channel:
            if known != channel:
                text = "a channel is declared again with other content"
                self._problems.add("channel_redeclared", text, offset)
            return
        topics[channel.id] = number_of(channel.topic)
        schema = self._schemas.get(channel.schema_id)
        self.topics.setdefault(channel.topic, TopicInfo(channel.encoding, schema))

    def _attach(self, found: AttachedFile) -> None:
        if len(self.attachments) < MAX_ATTACHMENTS:
            attachment = Attachment(found.size, self.path, found.offset)
            self.attachments.setdefault(found.name, attachment)
