"""One file of a flight: its head, and every entry on its topic."""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from typing import Any

from black_box_cog.encoders import Encode, OriginTexts, encoder_of
from black_box_cog.flight_metadata import FlightMetadata
from black_box_cog.ingest_queue import Entry, LogLine, Recorded
from black_box_cog.log_file import LogFile
from black_box_cog.timeline import Timeline
from up.commands.command import BaseCommand
from up.commands.location_command import LocationCommand
from up.flight_log.command_schema import schema_of
from up.flight_log.compression import compressor
from up.flight_log.flight_file import FlightFile
from up.flight_log.foxglove import (
    LOCATION_FIX,
    LOCATION_FIX_SCHEMA,
    LOG,
    LOG_SCHEMA,
    PLACE_TOPIC,
    location_fix,
    timestamp,
)
from up.flight_log.mcap_writer import McapWriter
from up.quick_dataclass import dataclass

LOG_TOPIC = "log"
_ANY_OBJECT = {"type": "object"}


@dataclass(frozen=True, slots=True)
class CommandForm:
    """The schema of a Command class's data, and the function that encodes a Command."""

    schema: dict[str, Any]
    encode: Encode


_forms: dict[type[BaseCommand], CommandForm] = {}


def form_of(cls: type[BaseCommand]) -> CommandForm:
    """Return the form of a class; the first call takes half a millisecond on a PC."""
    form = _forms.get(cls)
    if form is None:
        form = _forms[cls] = CommandForm(schema_of(cls), encoder_of(cls))
    return form


@dataclass(frozen=True, slots=True)
class _Channel:
    number: int
    encode: Callable[[Any], str] | None = None


class LogSegment:
    """Writes one file from its head to its summary; an OSError comes from the file.

    A Command that cannot be encoded is left out: ``unwritten`` counts by topic. Entries wait for
    `flush`, which writes them as one compressed chunk; ``lost`` counts messages that did not fit.
    """

    def __init__(self, file: LogFile, name: FlightFile, timeline: Timeline) -> None:
        self.file = file
        self.name = name
        self.unwritten: Counter[str] = Counter()
        self.lost = 0
        self._timeline = timeline
        self._writer = McapWriter(file.put, compress=compressor())
        self._channels: dict[Any, _Channel] = {}
        self._origins = OriginTexts()

    def head(self, metadata: FlightMetadata) -> Iterator[None]:
        """Write the head of a file, in pieces; the caller must exhaust the iterator."""
        started = timestamp_text(self._timeline.start_unix_s)
        self._writer.start()
        self._writer.add_metadata(
            "flight", metadata.flight(started) | {"part": str(self.name.part)}
        )
        yield
        self._writer.add_metadata("versions", metadata.versions())
        yield
        now_ns = int(self._timeline.start_unix_s * 1e9)
        for name, data in metadata.config_files():
            self._writer.add_attachment(f"config/{name}", "text/yaml", data, now_ns)
            yield

    def put(self, entry: Entry) -> None:
        time_s, subject, origin = entry
        kind = subject.topic if type(subject) is Recorded else type(subject)
        time_ns = self._timeline.log_ns(time_s)
        try:
            channel = self._channels.get(kind) or self._open(kind, subject)
            if channel.encode is not None:
                data = self._origins.ended(channel.encode(subject), origin)
            elif type(subject) is Recorded:
                data = self._origins.ended(subject.text, origin)
            else:
                data = _line(subject, time_ns)
        except Exception:  # noqa: BLE001 - an invalid Command must not end the recording
            self.unwritten[getattr(subject, "NAME", LOG_TOPIC)] += 1
            return
        self._writer.message(channel.number, time_ns, data)
        if kind is LocationCommand:
            self._writer.message(self._place().number, time_ns, _place(subject, time_ns))

    def flush(self) -> None:
        in_chunk = self._writer.end_chunk()
        try:
            self.file.flush()
        except OSError:
            # A chunk is one record of the file.
            self.lost = in_chunk or self.file.lost
            raise

    def finish(self) -> None:
        """Write the summary, with which a viewer can open the file at any position immediately."""
        self._writer.finish()
        self.file.flush()
        self.file.sync()

    def _open(self, kind: Any, subject: Any) -> _Channel:
        """Write schema and channel of a new topic."""
        if isinstance(subject, BaseCommand):
            cls = type(subject)
            form = form_of(cls)
            schema = self._writer.add_schema(cls.NAME, form.schema)
            channel = _Channel(self._writer.add_channel(cls.NAME, schema), form.encode)
        elif isinstance(subject, Recorded):
            schema = self._writer.add_schema(kind, _ANY_OBJECT)
            channel = _Channel(self._writer.add_channel(kind, schema))
        else:
            schema = self._writer.add_schema(LOG, LOG_SCHEMA)
            channel = _Channel(self._writer.add_channel(LOG_TOPIC, schema))
        self._channels[kind] = channel
        return channel

    def _place(self) -> _Channel:
        channel = self._channels.get(PLACE_TOPIC)
        if channel is None:
            schema = self._writer.add_schema(LOCATION_FIX, LOCATION_FIX_SCHEMA)
            channel = _Channel(self._writer.add_channel(PLACE_TOPIC, schema))
            self._channels[PLACE_TOPIC] = channel
        return channel


def timestamp_text(unix_s: float) -> str:
    """Return a moment as text: UTC, to the second."""
    return datetime.fromtimestamp(unix_s, UTC).isoformat(timespec="seconds")


def _line(line: LogLine, time_ns: int) -> bytes:
    content: dict[str, Any] = {
        "timestamp": timestamp(time_ns),
        "level": line.level,
        "message": line.message,
        "name": line.name,
        "file": "",
        "line": 0,
    }
    if line.code:
        content |= {"code": line.code, "fields": line.fields}
    return json.dumps(content, separators=(",", ":")).encode("ascii")


def _place(command: LocationCommand, time_ns: int) -> bytes:
    content = location_fix(
        time_ns,
        command.latitude_deg,
        command.longitude_deg,
        command.altitude_m,
        command.accuracy_m,
    )
    return json.dumps(content, separators=(",", ":")).encode("ascii")
