"""Messages as CSV lines: every message of one topic, or all topics at one rate.

The paths of a topic are known only after its last message. The lines are therefore kept in a file,
``spool``, until then: each message is decoded once, and only one line is in memory.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, TextIO

from up.fields import printable
from up_flightlog.export.track import utc_text
from up_flightlog.read.flight_log import LoggedMessage

TIME, WALL_TIME, AGE = "time_s", "time", "age_s"
_FORMULA = ("=", "+", "-", "@")
_GROUP, _PART = "\x1d", "\x1f"
"""Separate topics, and their parts, in the spool: no cell contains a control character."""
_OPEN, _CLOSE = object(), object()


class _Topic:
    """The newest cells of a topic, in the order in which its paths appeared."""

    def __init__(self) -> None:
        self.paths: dict[str, int] = {}
        self.time_s = 0.0
        self.part = ""
        self._places: dict[tuple[object, ...], list[int] | None] = {}

    def take(self, message: LoggedMessage) -> None:
        self.time_s = message.time_s
        keys: list[object] = []
        values: list[Any] = []
        _flatten(message.data, keys, values)
        # Nearly all messages of a topic have the same keys.
        shape = tuple(keys)
        if shape not in self._places:
            found = [self.paths.setdefault(path, len(self.paths)) for path, _ in flat(message.data)]
            self._places[shape] = None if found == [*range(len(found))] else found
        cells = [repr(v) if type(v) is float or type(v) is int else _text(v) for v in values]
        places = self._places[shape]
        if places is not None:
            by_place = dict(zip(places, cells, strict=True))
            cells = [by_place.get(place, "") for place in range(len(self.paths))]
        self.part = f"{len(cells)}{_PART}{','.join(cells)}"


def topic_lines(
    messages: Iterable[LoggedMessage], start_unix_s: float, spool: TextIO
) -> Iterator[str]:
    """Yield the header and a line for every message of one topic."""
    topic = _Topic()
    for message in messages:
        topic.take(message)
        spool.write(f"{_times(message.time_s, start_unix_s)}{_GROUP}{topic.part}\n")
    yield _line(map(_text, (TIME, WALL_TIME, *topic.paths)))
    yield from _lines(spool, [topic], 0)


def wide_lines(
    messages: Iterable[LoggedMessage],
    start_unix_s: float,
    length_s: float,
    rate_hz: float,
    spool: TextIO,
) -> Iterator[str]:
    """Yield the header and ``rate_hz`` lines per second with the newest values of every topic.

    ``messages`` are in the order of time. Each topic has a column with the age of its values
    (seconds): a silent source keeps its last values while their age grows.
    """
    topics: dict[str, _Topic] = {}
    waiting = iter(messages)
    message = next(waiting, None)
    for number in range(int(length_s * rate_hz) + 1):
        time_s = number / rate_hz
        while message is not None and message.time_s <= time_s:
            _topic_of(message, topics).take(message)
            message = next(waiting, None)
        parts = [f"{each.part}{_PART}{time_s - each.time_s:.3f}" for each in topics.values()]
        spool.write(_GROUP.join((_times(time_s, start_unix_s), *parts)) + "\n")
    # Messages after the last line have columns, too.
    while message is not None:
        _topic_of(message, topics).take(message)
        message = next(waiting, None)
    head = [TIME, WALL_TIME]
    for name, topic in topics.items():
        head += [f"{name}.{path}" for path in (*topic.paths, AGE)]
    yield _line(map(_text, head))
    yield from _lines(spool, [*topics.values()], 1)


def _topic_of(message: LoggedMessage, topics: dict[str, _Topic]) -> _Topic:
    topic = topics.get(message.topic)
    if topic is None:
        topic = topics[message.topic] = _Topic()
    return topic


def _lines(spool: TextIO, topics: Sequence[_Topic], more: int) -> Iterator[str]:
    """Yield the lines with the cells that were unknown when they were written.

    ``more`` is the number of cells of each topic that follow those of its paths.
    """
    widths = [len(topic.paths) for topic in topics]
    spool.seek(0)
    for line in spool:
        times, *parts = line[:-1].split(_GROUP)
        cells = [times]
        for width, part in zip(widths, parts, strict=False):
            count, known, *rest = part.split(_PART)
            cells += [known][: int(count)]
            cells += [""] * (width - int(count))
            cells += rest
        cells += [""] * sum(width + more for width in widths[len(parts) :])
        yield _line(cells)


def _line(cells: Iterable[str]) -> str:
    return ",".join(cells) + "\n"


def _times(time_s: float, start_unix_s: float) -> str:
    return f"{time_s:.6f},{utc_text(start_unix_s + time_s) or ''}"


def flat(data: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Return the values of a message by dotted paths; an empty inner map yields nothing."""
    found: list[tuple[str, Any]] = []
    _add_flat(data, "", found)
    return found


def _add_flat(data: Mapping[str, Any], prefix: str, found: list[tuple[str, Any]]) -> None:
    for key, value in data.items():
        if type(value) is dict:
            _add_flat(value, f"{prefix}{key}.", found)
        else:
            found.append((prefix + key, value))


def _flatten(data: Mapping[str, Any], keys: list[object], values: list[Any]) -> None:
    """Add the values in the order of `flat`, and keys that tell one structure from another."""
    if dict not in map(type, data.values()):
        keys += data
        values += data.values()
        return
    for key, value in data.items():
        keys.append(key)
        if type(value) is dict:
            keys.append(_OPEN)
            _flatten(value, keys, values)
            keys.append(_CLOSE)
        else:
            values.append(value)


def _text(value: Any) -> str:
    return _text_of(value) if type(value) is str else _quoted(cell(value))


@lru_cache(maxsize=1024)
def _text_of(text: str) -> str:
    return _quoted(cell(text))


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if "," in text or '"' in text else text


def cell(value: Any) -> str:
    """Return a value as a cell: numbers in full precision, empty for null and not-a-number.

    Text becomes one line; one that a spreadsheet would read as a formula gets an apostrophe first.
    """
    if type(value) is float:
        return repr(value) if math.isfinite(value) else ""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if not isinstance(value, str):
        value = json.dumps(value, ensure_ascii=False)
    text = printable(value)
    return f"'{text}" if text.startswith(_FORMULA) else text
