"""The HTTP resources of the page of recorded flights: what there is, and windows of it."""

from __future__ import annotations

import json
import math
from array import array
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from twisted.web import http

from up_flightlog.columns.build import TRACK
from up_flightlog.columns.column import Column, Points
from up_flightlog.columns.column_file import ColumnFile
from up_ground.web.access import Access
from up_ground.web.site import PageResource, refuse, send
from up_ground.web.static_files import StaticFiles

PAGE = b"/log.html"
DATA = b"/log/"
MAX_PIXELS = 8192
MAX_SAMPLES = 131_072
"""Of a spectrum."""
MAX_TRACK = 4000


class QueryError(Exception):
    """A request that cannot be answered; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class ShownFlight:
    """A flight under the name of its first file."""

    name: str
    file: ColumnFile


class LogResource(PageResource):
    """Serves the page, and below ``/log/``:

    * ``index``: JSON: the flights, their columns (name, unit, values), bands and events.
    * ``window?flight=&column=&begin=&end=&pixels=``: what a chart shows of a span.
    * ``samples?flight=&column=&begin=&end=``: the values of a span, `MAX_SAMPLES` at most.
    * ``track?flight=&column=``: times, east, north, and the values of a column there.

    The last three are binary: times as doubles, then values as floats, little-endian.
    """

    def __init__(self, access: Access, files: StaticFiles, flights: list[ShownFlight]) -> None:
        super().__init__(access, files)
        self._flights = flights
        self._index = json.dumps(
            {"flights": [_about(each) for each in flights]}, allow_nan=False
        ).encode()
        self._answers: dict[bytes, Callable[[Any], bytes]] = {
            DATA + b"window": self._window,
            DATA + b"samples": self._samples,
            DATA + b"track": self._track,
        }

    def get(self, request: Any) -> Any:
        if request.path == DATA + b"index":
            request.setHeader(b"content-type", b"application/json")
            return send(request, self._index)
        answer = self._answers.get(request.path)
        if answer is None:
            return self.file(request, PAGE if request.path == b"/" else request.path)
        try:
            content = answer(request)
        except QueryError as error:
            return refuse(request, http.BAD_REQUEST, str(error))
        request.setHeader(b"content-type", b"application/octet-stream")
        return send(request, content)

    def _window(self, request: Any) -> bytes:
        pixels = _whole(request, b"pixels", 1, MAX_PIXELS)
        return self._column(request).window(*_span(request), pixels).encoded()

    def _samples(self, request: Any) -> bytes:
        return self._column(request).samples(*_span(request), MAX_SAMPLES).encoded()

    def _track(self, request: Any) -> bytes:
        columns = {each.name: each for each in self._flight(request).columns}
        east, north = map(columns.get, TRACK)
        if east is None or north is None:
            return b""
        value = self._column(request)
        chosen = range(0, len(east.values), math.ceil(len(east.values) / MAX_TRACK))
        points = Points(
            array("d", (east.times_s[each] for each in chosen)),
            array("f", (column.values[each] for column in (east, north) for each in chosen)),
        )
        points.values.extend(value.at(time_s) for time_s in points.times_s)
        return points.encoded()

    def _flight(self, request: Any) -> ColumnFile:
        return self._flights[_whole(request, b"flight", 0, len(self._flights) - 1)].file

    def _column(self, request: Any) -> Column:
        columns = self._flight(request).columns
        return columns[_whole(request, b"column", 0, len(columns) - 1)]


def _about(flight: ShownFlight) -> dict[str, Any]:
    about = {key: value for key, value in flight.file.about.items() if key != "state"}
    columns = [
        {"name": each.name, "unit": each.unit, "count": len(each.values)}
        for each in flight.file.columns
    ]
    return {**about, "name": flight.name, "columns": columns}


def _text(request: Any, name: bytes) -> str:
    values = request.args.get(name, [])
    if len(values) != 1 or not values[0].isascii():
        raise QueryError(f"{name.decode()} must be given once")
    return str(values[0][:40].decode("ascii"))


def _whole(request: Any, name: bytes, minimum: int, maximum: int) -> int:
    text = _text(request, name)
    if not text.isdigit() or not minimum <= int(text) <= maximum:
        raise QueryError(f"{name.decode()} must be a whole number from {minimum} to {maximum}")
    return int(text)


def _span(request: Any) -> tuple[float, float]:
    try:
        begin_s, end_s = float(_text(request, b"begin")), float(_text(request, b"end"))
    except ValueError:
        raise QueryError("begin and end must be numbers, s") from None
    if not (math.isfinite(begin_s) and math.isfinite(end_s) and begin_s < end_s):
        raise QueryError("begin must be before end")
    return begin_s, end_s
