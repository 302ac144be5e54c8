"""The messages between a remote radio and its aircraft: one JSON object a datagram."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import Any

from up.commands.command import WireFields, value
from up.fields import printable
from up.flight_log.json_message import decode
from up_simulator.aircraft.flight import FlightState
from up_simulator.radio.sticks import Sticks

MAX_DATAGRAM = 2048


def _pulse() -> Any:
    return value(unit="us", minimum=800, maximum=2200)


@dataclass(frozen=True, slots=True)
class _Sticks(WireFields):
    ailerons: int = _pulse()
    elevator: int = _pulse()
    throttle: int = _pulse()
    rudder: int = _pulse()
    aux1: int = _pulse()
    aux2: int = _pulse()
    is_on: bool = value()


@dataclass(frozen=True, slots=True)
class _State(WireFields):
    roll_deg: float = value()
    pitch_deg: float = value()
    height_m: float = value()
    airspeed_m_s: float = value()


@dataclass(frozen=True, slots=True)
class _Answer(_State):
    sticks: dict[str, Any] = value()
    mode: str = value(max_length=20)
    is_taken_by_other: bool = value()


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
    return json.dumps({"sticks": None if sticks is None else _data(_Sticks, sticks)}).encode()


def read_sticks_of(datagram: bytes) -> Sticks | None:
    """Return the sticks in a datagram, None if it releases them; raises ``ValueError``."""
    found = decode(datagram).get("sticks", {})
    return None if found is None else _sticks_of(found)


def write_snapshot(snapshot: Snapshot) -> bytes:
    """Return the aircraft's answer."""
    state = {name: round(each, 3) for name, each in _data(_State, snapshot.state).items()}
    more = {"sticks": _data(_Sticks, snapshot.sticks), "mode": snapshot.mode}
    taken = {"is_taken_by_other": snapshot.is_taken_by_other}
    return json.dumps({**state, **more, **taken}).encode()


def read_snapshot(datagram: bytes) -> Snapshot:
    """Return an answer; raises ``ValueError`` if invalid."""
    found = _Answer.from_data(decode(datagram))
    known = dict.fromkeys((each.name for each in fields(FlightState)), 0.0)
    state = FlightState(**(known | _data(_State, found)))
    return Snapshot(state, _sticks_of(found.sticks), printable(found.mode), found.is_taken_by_other)


def _sticks_of(found: Any) -> Sticks:
    if not isinstance(found, dict):
        raise ValueError("sticks is not an object")
    return Sticks(**_Sticks.from_data(found).data)


def _data(kind: type[WireFields], source: object) -> dict[str, Any]:
    return {each.name: getattr(source, each.name) for each in fields(kind)}
