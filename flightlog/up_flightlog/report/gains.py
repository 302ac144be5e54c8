"""The gains in use, and their changes."""

from __future__ import annotations

from dataclasses import dataclass

from up.flight_log.gain_changes import Key, gains_of
from up.flight_log.origin_text import KEY
from up_flightlog.read.flight_log import FlightLog

VALUES, TUNINGS = "arduino.pids.values", "arduino.pids.tunings"


@dataclass(frozen=True, slots=True)
class GainSet:
    """Gains by loop, axis and term at a time; ``by`` is the origin, "" for a reported set."""

    time_s: float
    values: dict[Key, float]
    by: str


def gain_sets(log: FlightLog) -> list[GainSet]:
    """Return the sets in the order of time, without unchanged ones."""
    found: list[GainSet] = []
    requested_by = ""
    for message in log.messages(VALUES, TUNINGS):
        if message.topic == TUNINGS:
            if message.data.get("request") is not True:
                requested_by = str(message.data.get(KEY, ""))
            continue
        values = gains_of(message.data)
        if values and (not found or values != found[-1].values):
            found.append(GainSet(message.time_s, values, requested_by if found else ""))
    return found


def requested_sets(log: FlightLog) -> list[GainSet]:
    """Return the requested sets, accepted by the board or not."""
    return [
        GainSet(message.time_s, gains_of(data), str(message.data.get(KEY, "")))
        for message in log.messages(TUNINGS)
        if message.data.get("request") is not True
        and isinstance(data := message.data.get("pids"), dict)
    ]


def changes(before: GainSet, after: GainSet) -> list[tuple[Key, float | None, float | None]]:
    """Return the gains that differ, with both values."""
    keys = dict.fromkeys([*before.values, *after.values])
    pairs = ((key, before.values.get(key), after.values.get(key)) for key in keys)
    return [(key, old, new) for key, old, new in pairs if old != new]
