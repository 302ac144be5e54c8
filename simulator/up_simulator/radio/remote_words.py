"""The messages between a remote radio and its aircraft: one JSON object a datagram."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, fields
from typing import Any

from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.sticks import CHANNELS, Sticks

LONGEST = 2048
LOWEST_US, HIGHEST_US = 800, 2200
SEEN = ("roll_deg", "pitch_deg", "height_m", "airspeed_m_s")


@dataclass(frozen=True, slots=True)
class Seen:
    """The aircraft's answer: the state visible to a pilot on the ground, and the sticks.

    ``is_others``: another radio than the one that is answered moves them.
    """

    state: FlightState
    sticks: Sticks
    mode: str = ""
    is_others: bool = False


def write_sticks(sticks: Sticks | None) -> bytes:
    """Return the radio's datagram; None gives the sticks back and requests the state."""
    return json.dumps({"sticks": None if sticks is None else _sticks(sticks)}).encode("ascii")


def read_sticks_of(datagram: bytes) -> Sticks | None:
    """Return the sticks in a datagram, None for none; raises ``ValueError`` if invalid."""
    found = _object(datagram)["sticks"]
    return None if found is None else _read_sticks(found)


def write_seen(seen: Seen) -> bytes:
    """Return the aircraft's answer."""
    values = {name: round(getattr(seen.state, name), 3) for name in SEEN}
    words = {"sticks": _sticks(seen.sticks), "mode": seen.mode, "is_others": seen.is_others}
    return json.dumps({**values, **words}).encode("ascii")


def read_seen(datagram: bytes) -> Seen:
    """Return an answer; raises ``ValueError`` if invalid."""
    found = _object(datagram)
    values: dict[str, Any] = {each.name: 0.0 for each in fields(FlightState)}
    for name in SEEN:
        value = found[name]
        if type(value) not in (int, float) or not math.isfinite(value):
            raise ValueError(f"{name} is no number")
        values[name] = float(value)
    mode = found["mode"]
    if not isinstance(mode, str) or not (mode.isascii() and mode.isprintable()):
        raise ValueError("mode is no word")
    is_others = found["is_others"]
    if type(is_others) is not bool:
        raise ValueError("whose the sticks are is not said")
    return Seen(FlightState(**values), _read_sticks(found["sticks"]), mode[:20], is_others)


def _sticks(sticks: Sticks) -> dict[str, Any]:
    return {**{each: getattr(sticks, each) for each in CHANNELS}, "is_on": sticks.is_on}


def _read_sticks(found: Any) -> Sticks:
    if not isinstance(found, dict) or type(found.get("is_on")) is not bool:
        raise ValueError("these are no sticks")
    pulses: dict[str, int] = {}
    for channel in CHANNELS:
        pulse_us = found.get(channel)
        if type(pulse_us) is not int or not LOWEST_US <= pulse_us <= HIGHEST_US:
            raise ValueError(f"{channel} is no pulse")
        pulses[channel] = pulse_us
    return Sticks(**pulses, is_on=found["is_on"])


def _object(datagram: bytes) -> dict[str, Any]:
    try:
        found = json.loads(datagram)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    if not isinstance(found, dict):
        raise ValueError("it is no object")
    return _Complete(found)


class _Complete(dict[str, Any]):
    """A mapping in which a missing key is a wrong value, not a bug."""

    def __missing__(self, key: str) -> Any:
        raise ValueError(f"{key} is missing")
