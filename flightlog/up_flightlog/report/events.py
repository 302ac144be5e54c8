"""The events of a flight, one line each, in the order of time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from up.flight_log.origin_text import KEY, link_and_role
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.read.flight_log import FlightLog

MAX_ENTRIES = 400
_LINKS = {
    "arduino": "the Arduino",
    "android": "the phone",
    "mission_control": "the ground (through the proxy)",
    "ground": "a ground station",
}
_TEXT_FIELDS = {"black_box.mark": "text", "simulator.event": "event"}


@dataclass(frozen=True, slots=True)
class Event:
    """An event as one line."""

    time_s: float
    code: str
    text: str
    level: str = "info"


def events_of(log: FlightLog, context: FlightContext) -> list[Event]:
    """Return the events, at most 400 and then a line about the rest."""
    found = [*_states(context), *_from_commands(log), *_lines(context)]
    found.sort(key=lambda event: event.time_s)
    if len(found) > MAX_ENTRIES:
        more = f"{len(found) - MAX_ENTRIES} more events are not shown"
        found = [*found[:MAX_ENTRIES], Event(found[MAX_ENTRIES].time_s, "more", more)]
    return found


def _states(context: FlightContext) -> Iterator[Event]:
    for time_s, mode in context.modes:
        if mode is not None:
            yield Event(time_s, "flight_mode", f"flight mode {mode}")
    is_armed: bool | None = None
    is_failsafe: bool | None = None
    for state in context.states:
        if state.is_armed is not None and state.is_armed != is_armed:
            if is_armed is not None or state.is_armed:
                code = "armed" if state.is_armed else "disarmed"
                yield Event(state.time_s, code, code)
            is_armed = state.is_armed
        if state.is_failsafe is not None and state.is_failsafe != is_failsafe:
            if state.is_failsafe:
                yield Event(state.time_s, "failsafe", "failsafe: the receiver is lost", "bad")
            elif is_failsafe is not None:
                yield Event(state.time_s, "failsafe_over", "the receiver is back")
            is_failsafe = state.is_failsafe


def _from_commands(log: FlightLog) -> Iterator[Event]:
    handlers: dict[str, Callable[[Mapping[str, Any]], tuple[str, ...] | None]] = {
        "up.link.state": _link,
        "up.panic": _panic,
        "up.arm": lambda data: ("arm", f"arming requested by {_origin(data)}"),
        "up.disarm": lambda data: ("disarm", f"disarming requested by {_origin(data)}"),
        "up.flight_mode.set": lambda data: (
            "flight_mode_request",
            f"flight mode {_text(data.get('mode'))} requested by {_origin(data)}",
        ),
        "up.altitude.change": _altitude,
        "arduino.pids.tunings": _gains,
        "android.battery.low": lambda data: (
            ("battery_low", "the phone's battery is low", "warning")
            if data.get("low") is True
            else None
        ),
    }
    states: dict[str, bool] = {}
    for message in log.messages(*handlers, *_TEXT_FIELDS):
        if message.topic in _TEXT_FIELDS:
            text = _text(message.data.get(_TEXT_FIELDS[message.topic]))
            who = "mark" if message.topic == "black_box.mark" else "scenario"
            yield Event(message.time_s, who, f"{who}: {text}")
            continue
        event = handlers[message.topic](message.data)
        if event is not None and _is_change(message.topic, message.data, states):
            yield Event(message.time_s, *event)


def _is_change(topic: str, data: Mapping[str, Any], states: dict[str, bool]) -> bool:
    """Return whether a state changed; the initial state has no link and no panic."""
    key = {"up.link.state": "connected", "up.panic": "panic"}.get(topic)
    if key is None:
        return True
    name, is_on = f"{topic} {data.get('link')}", data.get(key) is True
    was_on, states[name] = states.get(name, False), is_on
    return is_on != was_on


def _link(data: Mapping[str, Any]) -> tuple[str, ...] | None:
    link = _text(data.get("link"))
    name = _LINKS.get(link, f"the link {link}")
    return (
        ("connected", f"{name} is connected")
        if data.get("connected") is True
        else ("disconnected", f"{name} is disconnected", "warning")
    )


def _panic(data: Mapping[str, Any]) -> tuple[str, ...] | None:
    if data.get("panic") is True:
        return "panic", f"Panic Mode: period of {_text(data.get('delay_ms'))} ms", "warning"
    return "panic_over", "Panic Mode ends"


def _altitude(data: Mapping[str, Any]) -> tuple[str, ...] | None:
    if data.get("mode") != "required":
        return None
    return (
        "altitude_request",
        f"altitude {_text(data.get('altitude'))} m requested by {_origin(data)}",
    )


def _gains(data: Mapping[str, Any]) -> tuple[str, ...] | None:
    if data.get("request") is True:
        return None
    return "gains", f"gains were set by {_origin(data)}"


def _lines(context: FlightContext) -> Iterator[Event]:
    for line in context.log_lines:
        level = "bad" if line.level >= 4 else "warning" if line.level == 3 else "info"
        text = f"{line.name}: {line.text}" if line.name else line.text
        yield Event(line.time_s, line.code or "log", text, level)


def _origin(data: Mapping[str, Any]) -> str:
    link, _ = link_and_role(data.get(KEY))
    return _LINKS.get(link, link or "unknown")


def _text(value: object) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    return "?" if value is None else str(value)[:500]
