"""Messages as rows: every message of one topic, or all topics at one rate."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from up.fields import printable
from up_flightlog.export.track import utc_text
from up_flightlog.read.flight_log import LoggedMessage

TIME, WALL_TIME, AGE = "time_s", "time", "age_s"
_FORMULA = ("=", "+", "-", "@")


def columns_of(messages: Iterable[LoggedMessage]) -> dict[str, list[str]]:
    """Return the dotted paths of each topic, in the order of first appearance."""
    columns: dict[str, dict[str, None]] = {}
    seen: dict[str, set[tuple[Any, ...]]] = {}
    for message in messages:
        # Nearly all messages of a topic have the same keys.
        shape, shapes = _shape(message.data), seen.setdefault(message.topic, set())
        if shape in shapes:
            continue
        shapes.add(shape)
        paths = columns.setdefault(message.topic, {})
        for path, _ in flat(message.data):
            paths.setdefault(path)
    return {topic: list(paths) for topic, paths in columns.items()}


def topic_rows(
    messages: Iterable[LoggedMessage], paths: list[str], start_unix_s: float
) -> Iterator[list[str]]:
    """Yield the header and a row for every message of one topic."""
    yield [cell(name) for name in (TIME, WALL_TIME, *paths)]
    for message in messages:
        yield [*_times(message.time_s, start_unix_s), *_cells(message.data, paths)]


def wide_rows(
    messages: Iterable[LoggedMessage],
    columns: Mapping[str, list[str]],
    start_unix_s: float,
    length_s: float,
    rate_hz: float,
) -> Iterator[list[str]]:
    """Yield the header and ``rate_hz`` rows per second with the newest values of every topic.

    ``messages`` are in the order of time. Each topic has a column with the age of its values
    (seconds): a silent source keeps its last values while their age grows.
    """
    head = [TIME, WALL_TIME]
    for topic, paths in columns.items():
        head += [f"{topic}.{path}" for path in (*paths, AGE)]
    yield [cell(name) for name in head]
    newest: dict[str, tuple[float, list[str]]] = {}
    waiting = iter(messages)
    message = next(waiting, None)
    for number in range(int(length_s * rate_hz) + 1):
        time_s = number / rate_hz
        while message is not None and message.time_s <= time_s:
            newest[message.topic] = (message.time_s, _cells(message.data, columns[message.topic]))
            message = next(waiting, None)
        row = _times(time_s, start_unix_s)
        for topic, paths in columns.items():
            if topic in newest:
                came_s, cells = newest[topic]
                row += [*cells, f"{time_s - came_s:.3f}"]
            else:
                row += [""] * (len(paths) + 1)
        yield row


def _cells(data: Mapping[str, Any], paths: Iterable[str]) -> list[str]:
    found = dict(flat(data))
    values = map(found.get, paths)
    # Most are finite numbers, which need no call of `cell`.
    return [repr(v) if type(v) is float and v - v == 0.0 else cell(v) for v in values]


def _times(time_s: float, start_unix_s: float) -> list[str]:
    return [f"{time_s:.6f}", utc_text(start_unix_s + time_s) or ""]


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


def _shape(data: Mapping[str, Any]) -> tuple[Any, ...]:
    """Return the keys of a message, with those of its inner maps."""
    if dict not in map(type, data.values()):
        return tuple(data)
    return tuple(
        [(key, _shape(each) if type(each) is dict else None) for key, each in data.items()]
    )


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
