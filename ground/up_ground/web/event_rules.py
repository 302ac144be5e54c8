"""The rules for events and alarms: which values of a frame, which code and text."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from up.commands.board_datum import Alarm as BoardAlarm
from up.commands.board_schema import ALARMS as BOARD_ALARMS
from up_ground.status_text import busy_text
from up_ground.telemetry import Telemetry

INFO, WARNING, ALARM = "info", "warning", "alarm"
NOT_YET = "not yet"
"""A part that was never connected and never reported anything does not count as lost."""
HOLDS_S = {each.kind: each.hold_s for each in BOARD_ALARMS if each.hold_s is not None}
BATTERY_LOW = 20.0
BATTERY_EMPTY = 10.0
_BATTERY_BACK = 3.0


@dataclass(frozen=True, slots=True)
class Report:
    """Level, code and text of an event; ``fields`` are its values."""

    level: str
    code: str
    text: str
    fields: Mapping[str, Any] = field(default_factory=dict)


Describe = Callable[[Any, Any], Report | None]


@dataclass(frozen=True, slots=True)
class EventRule:
    """A value of the frame: ``read`` returns it or None (unknown, does not count as a change).

    ``describe(before, now)`` returns the report of the change, or None for no event; ``before`` is
    None for the first value.
    """

    key: str
    kind: str
    read: Callable[[Telemetry], Any]
    describe: Describe


def is_board_alarm(alarm: BoardAlarm, telemetry: Telemetry) -> bool | None:
    """Return whether the condition of an alarm of the board holds; None if unknown."""
    read = telemetry.flag if alarm.above is None else telemetry.number
    return alarm.holds(read("arduino", alarm.name))


def _board_rule(alarm: BoardAlarm) -> EventRule:
    def describe(before: Any, now: Any) -> Report | None:
        if now:
            return Report(alarm.level, alarm.code, alarm.text)
        return Report(INFO, alarm.end_code, alarm.end) if before and alarm.end else None

    return EventRule(alarm.kind, alarm.event, lambda t: is_board_alarm(alarm, t), describe)


def board_state(telemetry: Telemetry) -> bool | str | None:
    """Return whether the Arduino is connected, or ``NOT_YET``; None if not reported."""
    return _state(telemetry, "arduino", ("flight", "rx", "servo"))


def phone_state(telemetry: Telemetry) -> bool | str | None:
    """Return whether the phone is connected, or ``NOT_YET``; None if not reported."""
    return _state(telemetry, "android", ("battery",))


def _state(telemetry: Telemetry, link: str, readings: tuple[str, ...]) -> bool | str | None:
    is_there = telemetry.flag(link, "connected")
    was_there = any(telemetry.number("age_ms", each) is not None for each in readings)
    return NOT_YET if is_there is False and not was_there else is_there


def _part(key: str, name: str, read: Callable[[Telemetry], Any], level: str) -> EventRule:
    """Return a rule of a part that may connect after the program, and disconnect."""

    def describe(before: Any, now: Any) -> Report | None:
        if now is False or (now is NOT_YET and before is True):
            return Report(level, f"{key}_lost", f"the {name} is disconnected")
        if now is NOT_YET:
            text = f"the {name} is not connected yet"
            return Report(INFO, f"{key}_awaited", text) if before is None else None
        if before is None:
            return None
        again = "" if before is NOT_YET else " again"
        return Report(INFO, f"{key}_connected", f"the {name} is connected{again}")

    return EventRule(key, "link", read, describe)


def _armed(before: Any, now: Any) -> Report | None:
    if before is None:
        return Report(WARNING, "armed", "the aircraft is armed") if now else None
    return Report(WARNING, "armed", "armed") if now else Report(INFO, "disarmed", "disarmed")


def _changed(code: str, text: str, level: str = INFO) -> Describe:
    def describe(before: Any, now: Any) -> Report | None:
        if before is None:
            return None
        return Report(level, code, f"{text} {now} (was {before})", {"value": now, "before": before})

    return describe


def _vetoes(before: Any, now: Any) -> Report | None:
    is_armed, vetoes = now
    if before is None and not vetoes:
        return None
    if before is not None and before[1] == vetoes:
        return None
    if not vetoes:
        return Report(INFO, "vetoes_cleared", "no veto against arming")
    text = "vetoes against arming again" if is_armed else "vetoes against arming"
    return Report(INFO, "vetoes", f"{text}: {'; '.join(vetoes)}"[:400], {"value": list(vetoes)})


def _read_vetoes(telemetry: Telemetry) -> Any:
    vetoes = telemetry.texts("vetoes")
    return None if vetoes is None else (bool(telemetry.flag("armed")), tuple(sorted(vetoes)))


@dataclass(frozen=True, slots=True)
class _Busy:
    """The Raspberry Pi is busy: all instances are equal, so a new load figure is not a change."""

    text: str = field(compare=False)


def _read_busy(telemetry: Telemetry) -> Any:
    is_busy = telemetry.flag("load", "panic")
    return _Busy(busy_text(telemetry)) if is_busy else is_busy


def _busy(before: Any, now: Any) -> Report | None:
    if now:
        return Report(INFO, "busy", now.text)
    return None if before is None else Report(INFO, "not_busy", "Raspberry Pi no longer busy")


def _source(reading: str) -> EventRule:
    describe = _changed("source_changed", f"{reading} comes from", WARNING)
    return EventRule(f"source {reading}", "source", lambda t: t.text("source", reading), describe)


def _competitor(before: Any, now: Any) -> Report | None:
    text = f"another phone, {now}, is refused: one is connected"
    return Report(WARNING, "phone_refused", text, {"value": now})


EVENT_RULES: tuple[EventRule, ...] = (
    EventRule("flight mode", "mode", lambda t: t.text("flight_mode"),
              _changed("flight_mode", "flight mode")),
    EventRule("mode", "mode", lambda t: t.text("mode"), _changed("mode", "mode")),
    EventRule("switch", "mode", lambda t: t.text("arduino", "switch"),
              _changed("switch", "switch position")),
    EventRule("armed", "armed", lambda t: t.flag("armed"), _armed),
    *(_board_rule(each) for each in BOARD_ALARMS if each.event),
    _part("board", "Arduino", board_state, ALARM),
    _part("phone", "phone", phone_state, WARNING),
    EventRule("competitor", "source", lambda t: t.text("android", "competitor"), _competitor),
    EventRule("panic", "panic", _read_busy, _busy),
    EventRule("vetoes", "veto", _read_vetoes, _vetoes),
    EventRule("role", "link", lambda t: t.text("ground", "role", limit=12),
              _changed("role", "the ground's role is", WARNING)),
    *(_source(each) for each in ("orientation", "location", "altitude", "heading", "battery")),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Alarm:
    """A fault; one alarm of each ``kind`` at most, ``code`` is its cause."""

    kind: str
    level: str
    text: str
    code: str


@dataclass(frozen=True, slots=True)
class LinkSnapshot:
    """State of the link at a moment; None: not known."""

    is_open: bool
    reason: str
    is_aircraft_online: bool | None
    was_heard: bool
    is_silent: bool
    is_late: bool = False
    """Telemetry arrives, but is as old as if the link were silent."""


def faults(telemetry: Telemetry, link: LinkSnapshot, was_low: bool, had_board: bool) -> list[Alarm]:
    """Return the present faults; ``was_low``: the battery's alarm is active."""
    found: list[Alarm] = []
    if link.was_heard and link.is_silent:
        found.append(_silence(link))
    flag = telemetry.flag
    for each in BOARD_ALARMS:
        is_hidden = each.unless and flag("arduino", each.unless)
        if each.lasts and not is_hidden and is_board_alarm(each, telemetry):
            level = each.level_armed if flag("armed") else each.level
            found.append(Alarm(each.kind, level, each.text, each.code))
    if board_state(telemetry) is NOT_YET and not had_board:
        found.append(Alarm("board", WARNING, "the Arduino is not connected yet", "board_awaited"))
    elif flag("arduino", "connected") is False:
        found.append(Alarm("board", ALARM, "the Arduino is disconnected", "board_lost"))
    if phone_state(telemetry) is False:
        found.append(Alarm("phone", WARNING, "the phone is disconnected", "phone_lost"))
    level_percent = telemetry.number("android", "batteryLevel")
    if level_percent is not None:
        bound = BATTERY_LOW + (_BATTERY_BACK if was_low else 0.0)
        if level_percent < bound:
            is_empty = level_percent < BATTERY_EMPTY
            text = f"the phone's battery is {'nearly empty' if is_empty else 'low'}"
            code = "battery_empty" if is_empty else "battery_low"
            found.append(Alarm("battery", ALARM if is_empty else WARNING, text, code))
    return found


def _silence(link: LinkSnapshot) -> Alarm:
    if not link.is_open:
        text = f"no link: {link.reason}"[:300] if link.reason else "no link"
        return Alarm("silent", ALARM, text, "no_link")
    if link.is_aircraft_online is False:
        text = "the aircraft is not connected to the proxy"
        return Alarm("silent", ALARM, text, "aircraft_offline")
    if link.is_late:
        return Alarm("silent", ALARM, "telemetry arrives too late", "late")
    return Alarm("silent", ALARM, "the aircraft is silent", "silent")
