"""The messages between a remote radio and its aircraft: one JSON object a datagram."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, fields
from typing import Any

from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.sticks import CHANNELS, Sticks

MAX_DATAGRAM = 2048
LOWEST_US, HIGHEST_US = 800, 2200
STATE_FIELDS = ("roll_deg", "pitch_deg", "height_m", "airspeed_m_s")


@dataclass(frozen=True, slots=True)
class Snapshot:
    """The aircraft's answer: the state visible to a pilot on the ground, and the sticks.

    ``is_taken_by_other``: another radio than the one that is answered moves them.
    """

    state: FlightState
    sticks: Sticks
    mode: str = ""
    is_taken_by_other: bool = False


def write_sticks(sticks: Sticks | None) -> bytes:
    """Return the radio's datagram; None releases the sticks and requests the state."""
    return json.dumps({"sticks": None if sticks is None else _sticks(sticks)}).encode("ascii")


def read_sticks_of(datagram: bytes) -> Sticks | None:
    """Return the sticks in a datagram, None if it releases them; raises ``ValueError``."""
    found = _object(datagram)["sticks"]
    return None if found is None else _read_sticks(found)


def write_snapshot(snapshot: Snapshot) -> bytes:
    """Return the aircraft's answer."""
    values: dict[str, Any] = {
        name: round(getattr(snapshot.state, name), 3) for name in STATE_FIELDS
    }
    words = {
        "sticks": _sticks(snapshot.sticks),
        "mode": snapshot.mode,
        "is_taken_by_other": snapshot.is_taken_by_other,
    }
    return json.dumps({**values, **words}).encode("ascii")


def read_snapshot(datagram: bytes) -> Snapshot:
    """Return an answer; raises ``ValueError`` if invalid."""
    found = _object(datagram)
    values: dict[str, Any] = {each.name: 0.0 for each in fields(FlightState)}
    for name in STATE_FIELDS:
        value = found[name]
        if type(value) not in (int, float) or not math.isfinite(value):
            raise ValueError(f"{name} is not a number")
        values[name] = float(value)
    mode = found["mode"]
    if not isinstance(mode, str) or not (mode.isascii() and mode.isprintable()):
        raise ValueError("mode is not a word")
    is_taken_by_other = found["is_taken_by_other"]
    if type(is_taken_by_other) is not bool:
        raise ValueError("is_taken_by_other is not true or false")
    return Snapshot(
        FlightState(**values), _read_sticks(found["sticks"]), mode[:20], is_taken_by_other
    )


def _sticks(sticks: Sticks) -> dict[str, Any]:
    return {**{each: getattr(sticks, each) for each in CHANNELS}, "is_on": sticks.is_on}


def _read_sticks(found: Any) -> Sticks:
    if not isinstance(found, dict) or type(found.get("is_on")) is not bool:
        raise ValueError("sticks is not an object")
    pulses: dict[str, int] = {}
    for channel in CHANNELS:
        pulse_us = found.get(channel)
        if type(pulse_us) is not int or not LOWEST_US <= pulse_us <= HIGHEST_US:
            raise ValueError(f"{channel} is not a pulse")
        pulses[channel] = pulse_us
    return Sticks(**pulses, is_on=found["is_on"])


def _object(datagram: bytes) -> dict[str, Any]:
    try:
        found = json.loads(datagram)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    if not isinstance(found, dict):
        raise ValueError("not an object")
    return _Required(found)


class _Required(dict[str, Any]):
    """A mapping in which a missing key is a wrong value, not a bug."""

    def __missing__(self, key: str) -> Any:
        raise ValueError(f"{key} is missing")
