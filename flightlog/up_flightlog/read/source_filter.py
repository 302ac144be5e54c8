"""The source that a provider followed for a reading at each time of a flight."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import compress
from typing import Any

from up.commands.roles import Role
from up.commands.telemetry_schema import READINGS
from up.flight_log.origin_text import KEY, link_and_role
from up.providers.source_arbiter import SourceArbiter
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.series import Columns, Series

SELECTED = "up.source.selected"
_BOARD_PRIORITY = 10
_LATER_S = 0.05
"""A selection is logged after the message that caused it."""


class SourceFilter:
    """Separates the messages that a provider used from those of sources that it did not follow.

    Without a logged selection (older logs never have one) a source is followed as by a provider
    without configuration: the board's while it is fresh, otherwise the first one.
    """

    def __init__(self, log: FlightLog) -> None:
        self._times_s: dict[str, list[float]] = {}
        self._links: dict[str, list[str]] = {}
        for each in log.messages(SELECTED):
            reading = str(each.data.get("reading"))
            self._times_s.setdefault(reading, []).append(each.time_s)
            self._links.setdefault(reading, []).append(str(each.data.get("source")))
        self._arbiters = {
            name: SourceArbiter(reading.source_s, lambda previous, source: None)
            for name, reading in READINGS.items()
        }

    def accepts(self, reading: str, time_s: float, data: Mapping[str, Any]) -> bool:
        """Return whether a message's source was followed; messages come in the order of time."""
        link, role = link_and_role(data.get(KEY))
        times_s = self._times_s.get(reading)
        if times_s:
            now, soon = bisect_right(times_s, time_s), bisect_right(times_s, time_s + _LATER_S)
            if soon > 0:
                return link in self._links[reading][max(now - 1, 0) : soon]
        priority = _BOARD_PRIORITY if role == Role.BOARD.value else 0
        return self._arbiters[reading].accepts(link, priority, time_s)


def from_selected_source(
    log: FlightLog, reading: str, topic: str, fields: Sequence[str]
) -> dict[str, Series]:
    """Return the series of the messages that a provider used, without required values."""
    accepts, found = partial(SourceFilter(log).accepts, reading), Columns(fields)
    for times_s, messages in log.batches(topic):
        used = [
            data.get("mode") != "required" and accepts(time_s, data)
            for time_s, data in zip(times_s, messages, strict=True)
        ]
        found.add_all(list(compress(times_s, used)), list(compress(messages, used)))
    return found.series
