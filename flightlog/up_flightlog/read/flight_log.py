"""One flight as its log records it: every part, every topic, in the order of time."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from up.flight_log.json_message import decode_all, number_at
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.read.log_files import LogFiles
from up_flightlog.read.log_index import MAX_PARTS, LogIndex
from up_flightlog.read.log_parts import Attachment, PartReader, TopicInfo
from up_flightlog.read.problems import LogProblem

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
    is indexed. Every pass opens the files again, so that nothing needs closing. ``is_complete``:
    every part ended properly. ``start_unix_s`` is 0 for a log without messages. ``topics`` counts
    the messages by topic.
    """

    def __init__(self, paths: Sequence[Path], index: LogIndex, parts: Sequence[PartReader]) -> None:
        self.paths = list(paths)
        self.topics: dict[str, int] = index.counts()
        self.on_decoded: Callable[[int], object] | None = None
        """Called with the number of messages of each batch, for a display of progress."""
        self.metadata: dict[str, dict[str, str]] = {}
        self.attachments: dict[str, Attachment] = {}
        self.is_complete = all(part.is_complete for part in parts)
        self._index = index
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
        index, parts = LogIndex(), []
        for number, path in enumerate(paths):
            part = PartReader(path, number)
            part.read(index)
            parts.append(part)
        faults = [part.fault for part in parts if part.fault is not None]
        if len(faults) == len(parts):
            raise faults[0]
        for number, count in index.drop_outliers().items():
            parts[number].report_outliers(count)
        index.finish()
        return cls(paths, index, parts)

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
        names, times, start_ns = self._names, self._index.times_ns, self._start_ns
        for position, number, data in self._decoded(topics, since_s, rate_hz):
            yield LoggedMessage(names[number], (times[position] - start_ns) * _NS, data)

    def series(self, topic: str, field: str) -> tuple[list[float], list[float]]:
        """Return the times, s, and the values of a field, a path with dots between its keys.

        Values that are not finite numbers are left out. Raises FlightLogError as `messages` does.
        """
        path = tuple(field.split("."))
        times, start_ns = self._index.times_ns, self._start_ns
        times_s: list[float] = []
        values: list[float] = []
        for position, _, data in self._decoded((topic,), 0.0):
            value = number_at(data, path)
            if value is not None:
                times_s.append((times[position] - start_ns) * _NS)
                values.append(value)
        return times_s, values

    def times(self, topic: str) -> list[float]:
        """Return the times of a topic's messages, s, without decoding them."""
        times, start_ns = self._index.times_ns, self._start_ns
        return [(times[each] - start_ns) * _NS for each in self._index.positions((topic,))]

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

    def _decoded(
        self, topics: Sequence[str], since_s: float, rate_hz: float | None = None
    ) -> Iterator[tuple[int, int, dict[str, Any]]]:
        index = self._index
        since_ns = self._start_ns + round(since_s / _NS) if since_s > 0 else 0
        unread: list[Callable[[int, str], None] | None] = [None] * len(self._names)
        encodings = [self._infos[name].is_json for name in self._names]
        positions: Iterator[int] = (
            each for each in index.positions(topics, since_ns) if encodings[index.name_of(each)]
        )
        if rate_hz is not None:
            positions = self._newest(positions, rate_hz)
        with LogFiles(self.paths) as files:
            size = _FIRST_BATCH
            while batch := list(islice(positions, size)):
                size = _BATCH
                if self.on_decoded is not None:
                    self.on_decoded(len(batch))
                raw = [files.read(*index.place_of(each)) for each in batch]
                for position, data in zip(batch, decode_all(raw), strict=True):
                    number = index.name_of(position)
                    if not isinstance(data, ValueError):
                        yield position, number, data
                        continue
                    add = unread[number]
                    if add is None:
                        add = unread[number] = self._infos[self._names[number]].add_unread
                    add(position, str(data))

    def _newest(self, positions: Iterable[int], rate_hz: float) -> Iterator[int]:
        """Yield the last position of each topic before each tick; ticks are k / rate_hz."""
        times, start_ns, name_of = self._index.times_ns, self._start_ns, self._index.name_of
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
            newest[name_of(position)] = position
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
