"""The reported settings of an aircraft at any moment of a flight."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from up.flight_log.flight_log import FlightLog

GAINS = "arduino.pids.values"
GAINS_WANTED = "arduino.pids.tunings"
PROFILE = "arduino.profile.values"


@dataclass(frozen=True, slots=True)
class Told:
    """Values from a moment of the flight on, s."""

    time_s: float
    values: dict[str, Any]


def told_at(told: Sequence[Told], time_s: float) -> Told | None:
    """Return the last reported value before a time; None without a report."""
    place = bisect_right(told, time_s, key=lambda each: each.time_s)
    return told[place - 1] if place else None


def gains_of(log: FlightLog) -> list[Told]:
    """Return the gains that the board reported; without a report, those requested from it.

    Raises FlightLogError when a file becomes unreadable.
    """
    told = _told(log, GAINS)
    if told:
        return told
    wanted = ((each.time_s, each.values.get("pids")) for each in _told(log, GAINS_WANTED))
    return [Told(time_s, gains) for time_s, gains in wanted if isinstance(gains, dict)]


def profile_of(log: FlightLog) -> list[Told]:
    """Return the reported profiles of the airframe; raises FlightLogError likewise."""
    return _told(log, PROFILE)


def _told(log: FlightLog, topic: str) -> list[Told]:
    return [
        Told(each.time_s, {key: value for key, value in each.data.items() if key[:1] != "_"})
        for each in log.messages(topic)
    ]
