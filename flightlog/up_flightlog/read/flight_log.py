"""One flight as its log records it: every part, every topic, in the order of time."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from operator import sub
from pathlib import Path
from typing import Any

from up.flight_log.json_message import decode_all
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.read.expanded_records import ExpandedRecords
from up_flightlog.read.log_files import LogFiles
from up_flightlog.read.log_index import MAX_PARTS, LogIndex
from up_flightlog.read.log_parts import Attachment, PartReader, TopicInfo
from up_flightlog.read.problems import LogProblem
from up_flightlog.read.series import Columns, Series

_NS = 1e-9
_FIRST_BATCH, _BATCH = 8, 64
"""Messages decoded together; a reader that wants the first one only waits for few."""


@dataclass(frozen=True, slots=True)
class LoggedMessage:
    """One message; ``time_s`` counts from the first message of the log."""

    topic: str
    time_s: float
    data: dict[str, Any]


class FlightLog:
    """The messages of one flight, indexed, and decoded on demand.

    Takes about 30 bytes of memory per message, whatever its size; a part is in memory only while it
    is indexed. Every pass opens the files again, so that nothing needs closing. Compressed chunks
    are expanded into memory or a temporary file, which ends with the object. ``is_complete``:
    every part ended properly; ``is_recording``: a recorder still writes it. ``start_unix_s`` is 0
    for a log without messages. ``topics`` counts the messages by topic.
    """

    def __init__(
        self,
        paths: Sequence[Path],
        index: LogIndex,
        parts: Sequence[PartReader],
        expanded: ExpandedRecords,
    ) -> None:
        self.paths = list(paths)
        self.topics: dict[str, int] = index.counts()
        self.on_decoded: Callable[[int], object] | None = None
        """Called with the number of messages of each batch, for a display of progress."""
        self.metadata: dict[str, dict[str, str]] = {}
        self.attachments: dict[str, Attachment] = {}
        self.is_complete = all(part.is_complete for part in parts)
        self.is_recording = any(part.is_recording for part in parts)
        self._index = index
        self._expanded = expanded
        self._names = list(index.topics)
        self._infos: dict[str, TopicInfo] = {}
        self._file_problems: list[LogProblem] = []
        for part in parts:
            self._add(part)
        times = index.times_ns
        self._start_ns = times[0] if times else 0
        self.start_unix_s = self._start_ns * _NS
        self.length_s = (times[-1] - self._start_ns) * _NS if times else 0.0

    @classmethod
    def read(cls, paths: Sequence[Path]) -> FlightLog:
        """Return the flight in these files, its parts in their order.

        Losses and damage are listed in ``problems``, and so is a part that is not a log if another
        one is. Raises FlightLogError (one sentence) when none can be read.
        """
        if not paths:
            raise FlightLogError("no flight log is named", "no_file")
        if len(paths) > MAX_PARTS:
            text = f"one flight has {MAX_PARTS} files at most, not {len(paths)}"
            raise FlightLogError(text, "too_many_files")
        try:
            return cls._read(paths)
        except MemoryError:
            text = f"{paths[0].name}: its messages need more memory than there is"
            raise FlightLogError(f"{text}: split it with mcap's tools", "no_memory") from None

    @classmethod
    def _read(cls, paths: Sequence[Path]) -> FlightLog:
        index, parts, expanded = LogIndex(), [], ExpandedRecords()
        for number, path in enumerate(paths):
            part = PartReader(path, number)
            part.read(index, expanded)
            parts.append(part)
        expanded.finish()
        faults = [part.fault for part in parts if part.fault is not None]
        if len(faults) == len(parts):
            raise faults[0]
        for number, count in index.drop_outliers().items():
            parts[number].report_outliers(count)
        index.finish()
        return cls(paths, index, parts, expanded)

    @property
    def problems(self) -> list[LogProblem]:
        """Return one problem for each kind of fault; decoding may add to them."""
        found = list(self._file_problems)
        for topic in self.topics:
            found += self._infos[topic].problems(topic) if topic in self._infos else []
        return found

    def schema(self, topic: str) -> dict[str, Any] | None:
        """Return the JSON Schema of a topic; None without a readable one."""
        info = self._infos.get(topic)
        if info is None or info.schema is None:
            return None
        try:
            schema = json.loads(info.schema.data)
        except (ValueError, RecursionError):
            return None
        return schema if isinstance(schema, dict) else None

    def messages(
        self, *topics: str, since_s: float = 0.0, rate_hz: float | None = None
    ) -> Iterator[LoggedMessage]:
        """Yield the messages of these topics (default: all) in the order of time.

        With ``rate_hz`` only the newest one of each topic at each multiple of that period.
        A message that is not a JSON object is counted in ``problems`` and left out. Raises
        FlightLogError when a file can no longer be read.
        """
        names, topic_of = self._names, self._index.topic_of
        for positions, found in self._batches(topics, since_s, rate_hz):
            times_s = self._times_s(positions)
            for position, time_s, data in zip(positions, times_s, found, strict=True):
                yield LoggedMessage(names[topic_of[position]], time_s, data)

    def batches(self, topic: str) -> Iterator[tuple[list[float], list[dict[str, Any]]]]:
        """Yield times (s) and data of some messages of a topic together, as `messages` does."""
        for positions, found in self._batches((topic,)):
            yield self._times_s(positions), found

    def columns(self, topic: str, fields: Sequence[str]) -> dict[str, Series]:
        """Return the series of fields, paths with dots between their keys.

        Values that are not finite numbers are left out. Raises FlightLogError as `messages` does.
        """
        columns = Columns(fields)
        for times_s, found in self.batches(topic):
            columns.add_all(times_s, found)
        return columns.series

    def series(self, topic: str, field: str) -> tuple[list[float], list[float]]:
        """Return the times, s, and the values of one field, as `columns` does."""
        found = self.columns(topic, (field,))[field]
        return found.times_s.tolist(), found.values.tolist()

    def times(self, topic: str) -> list[float]:
        """Return the times of a topic's messages, s, without decoding them."""
        return self._times_s(self._index.positions((topic,)))

    def longest_gap_s(self, topic: str) -> float:
        """Return the longest of the `gaps` of a topic; 0 without any."""
        times = self._index.times_ns
        found = [*map(times.__getitem__, self._index.positions((topic,))), *times[-1:]]
        return max(map(sub, found[1:], found), default=0) * _NS

    def gaps(self, longer_than_s: float, *topics: str) -> Iterator[tuple[float, float]]:
        """Yield start (s) and length of gaps between messages of these topics (default: any topic).

        Covers the time from their first message to the end of the log, without decoding them.
        """
        times, start_ns, limit_ns = self._index.times_ns, self._start_ns, longer_than_s / _NS
        before = None
        for position in self._index.positions(topics):
            now = times[position]
            if before is not None and now - before > limit_ns:
                yield (before - start_ns) * _NS, (now - before) * _NS
            before = now
        if before is not None and times[-1] - before > limit_ns:
            yield (before - start_ns) * _NS, (times[-1] - before) * _NS

    def _times_s(self, positions: Iterable[int]) -> list[float]:
        times, start_ns = self._index.times_ns, self._start_ns
        return [(times[each] - start_ns) * _NS for each in positions]

    def _batches(
        self, topics: Sequence[str], since_s: float = 0.0, rate_hz: float | None = None
    ) -> Iterator[tuple[list[int], list[dict[str, Any]]]]:
        """Yield positions and data of messages, several together; only those that are objects."""
        index = self._index
        since_ns = self._start_ns + round(since_s / _NS) if since_s > 0 else 0
        known = [each for each in topics or self._names if each in self._infos]
        readable = [each for each in known if self._infos[each].is_json]
        if not readable:
            return
        is_all = len(readable) == len(self._names)
        positions = iter(index.positions(() if is_all else readable, since_ns))
        if rate_hz is not None:
            positions = self._newest(positions, rate_hz)
        with LogFiles(self.paths, self._expanded) as files:
            size = _FIRST_BATCH
            while batch := list(islice(positions, size)):
                size = _BATCH
                if self.on_decoded is not None:
                    self.on_decoded(len(batch))
                found = decode_all([files.read(*each) for each in index.places_of(batch)])
                if {*map(type, found)} == {dict}:
                    yield batch, found  # type: ignore[misc]
                    continue
                for position, data in zip(batch, found, strict=True):
                    if isinstance(data, ValueError):
                        topic = self._names[index.topic_of[position]]
                        self._infos[topic].add_unread(position, str(data))
                    else:
                        yield [position], [data]

    def _newest(self, positions: Iterable[int], rate_hz: float) -> Iterator[int]:
        """Yield the last position of each topic before each tick; ticks are k / rate_hz."""
        times, start_ns, topic_of = self._index.times_ns, self._start_ns, self._index.topic_of
        newest: dict[int, int] = {}
        tick_s, step = -1.0, 0
        for position in positions:
            time_s = (times[position] - start_ns) * _NS
            if time_s > tick_s:
                yield from sorted(newest.values())
                newest.clear()
                step = math.floor(time_s * rate_hz)
                while step / rate_hz < time_s:
                    step += 1
                tick_s = step / rate_hz
            newest[topic_of[position]] = position
        yield from sorted(newest.values())

    def _add(self, part: PartReader) -> None:
        self._file_problems += part.problems
        for name, values in part.metadata.items():
            # Metadata of the first part describes the start; later parts repeat it or add to it.
            self.metadata[name] = {**values, **self.metadata.get(name, {})}
        for name, attachment in part.attachments.items():
            self.attachments.setdefault(name, attachment)
        for topic, info in part.topics.items():
            self._infos.setdefault(topic, info)
