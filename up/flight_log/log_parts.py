"""One part of a flight's log: indexes its messages and keeps the data to decode them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from struct import Struct

from up.fields import printable
from up.flight_log.log_files import LogFiles
from up.flight_log.log_index import LogIndex
from up.flight_log.mcap_format import JSON, MESSAGE, FlightLogError, Opcode
from up.flight_log.mcap_reader import read_record
from up.flight_log.mcap_records import AttachedFile, Channel, Metadata, Schema
from up.flight_log.problems import Problems
from up.flight_log.record_walk import RecordWalk, open_log

MOST_ATTACHMENTS = 1000
MOST_METADATA = 1000
MOST_KEPT_BYTES = 32 * 1024 * 1024
"""Of schemas, channels and metadata together."""
_MESSAGE_HEAD = Struct("<HIQ")
_MESSAGE = int(Opcode.MESSAGE)
_KEPT = frozenset({Opcode.SCHEMA, Opcode.CHANNEL, Opcode.METADATA, Opcode.ATTACHMENT})


@dataclass(frozen=True, slots=True)
class Attachment:
    """A file attached to the flight, read on demand."""

    name: str
    media_type: str
    size: int
    path: Path
    offset: int

    def read(self) -> bytes:
        """Return its content; raises FlightLogError."""
        with LogFiles([self.path]) as files:
            return files.read(0, self.offset, self.size)


class TopicNotes:
    """The metadata of a topic, and its messages that could not be read."""

    def __init__(self, encoding: str, schema: Schema | None) -> None:
        self.encoding = encoding
        self.schema = schema
        self._unread = 0
        self._reason = ""
        self._last = -1

    @property
    def is_json(self) -> bool:
        """Return whether its messages are JSON."""
        return self.encoding == JSON

    def note(self, position: int, reason: str) -> None:
        """Note a message that could not be read; repeated reports count once."""
        if position > self._last:
            self._last = position
            self._unread += 1
            self._reason = self._reason or reason

    def sentences(self, topic: str) -> list[str]:
        """Return the problems of the topic."""
        topic = printable(topic)
        if not self.is_json:
            return [f"{topic}: its messages are no JSON but {self.encoding!a:.40}: only listed"]
        if self._unread:
            plural = "" if self._unread == 1 else "s"
            return [f"{topic}: {self._unread} message{plural} left out: {self._reason}"]
        return []


class PartReader:
    """Reads one file into an index; ``fault`` is the reason if the whole file is unreadable."""

    def __init__(self, path: Path, number: int) -> None:
        self.path = path
        self.fault = ""
        self.is_complete = False
        self.metadata: dict[str, dict[str, str]] = {}
        self.attachments: dict[str, Attachment] = {}
        self.topics: dict[str, TopicNotes] = {}
        self._number = number
        self._noted = Problems(path.name)
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._kept = 0
        self._strays: list[str] = []

    @property
    def problems(self) -> list[str]:
        """Return the problems of the file."""
        return [*([self.fault] if self.fault else []), *self._noted.sentences, *self._strays]

    def note_strays(self, count: int) -> None:
        """Note how many messages were dropped for an impossible time."""
        what = "message has a time that cannot be and is"
        if count > 1:
            what = "messages have times that cannot be and are"
        self._strays = [f"{self.path.name}: {count} {what} put aside"]

    def read(self, index: LogIndex) -> None:
        """Add the messages of the file to the index, as far as they are readable."""
        try:
            with open_log(self.path) as file:
                walk = RecordWalk(file, self._noted)
                self._read(walk, index)
                self.is_complete = walk.is_complete
        except FlightLogError as error:
            self.fault = str(error)

    def _read(self, walk: RecordWalk, index: LogIndex) -> None:
        # Topic numbers by channel: the only lookup per message.
        topics: dict[int, int | None] = {}
        add = index.adder(self._number)
        unpack, size = _MESSAGE_HEAD.unpack_from, MESSAGE.size
        for opcode, offset, start, length in walk:
            if opcode == _MESSAGE:
                if length < size:
                    self._noted.note("a message without its fields is left out", offset)
                    continue
                channel, _, time_ns = unpack(walk.buffer, start)
                topic = topics.get(channel)
                if topic is None:
                    self._noted.note("a message of an unknown channel is left out", offset)
                    continue
                add(topic, time_ns, offset + size, length - size)
            elif opcode in _KEPT:
                content = walk.buffer[start : start + length]
                self._keep(opcode, offset, content, index.topic, topics)

    def _keep(
        self,
        opcode: int,
        offset: int,
        content: bytes,
        number_of: Callable[[str], int | None],
        topics: dict[int, int | None],
    ) -> None:
        record = read_record(opcode, offset, content, self._noted)
        if isinstance(record, AttachedFile):
            self._attach(record)
            return
        self._kept += len(content)
        if self._kept > MOST_KEPT_BYTES:
            self._noted.note("too many schemas, channels or metadata: the rest is left out", offset)
        elif isinstance(record, Schema):
            self._schemas.setdefault(record.id, record)
        elif isinstance(record, Channel):
            self._declare(record, offset, number_of, topics)
        elif isinstance(record, Metadata) and len(self.metadata) < MOST_METADATA:
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
                self._noted.note("a channel is declared again, as another one", offset)
            return
        topics[channel.id] = number_of(channel.topic)
        schema = self._schemas.get(channel.schema_id)
        self.topics.setdefault(channel.topic, TopicNotes(channel.encoding, schema))

    def _attach(self, found: AttachedFile) -> None:
        if len(self.attachments) < MOST_ATTACHMENTS:
            attachment = Attachment(
                found.name, found.media_type, found.size, self.path, found.offset
            )
            self.attachments.setdefault(found.name, attachment)
