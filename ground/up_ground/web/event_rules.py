"""Applies the rules of schema/ for alarms to telemetry, and those for events to the link."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from up.commands.event_rules import ALARM, AWAITED, MAX_TEXT, Report, is_hidden
from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import EVENTS
from up_ground.telemetry import Telemetry


def event_of(code: str, reason: str = "") -> Report:
    """Return an event that does not depend on telemetry (schema/events.yml)."""
    text = f"{EVENTS[code].text}: {reason}" if reason else EVENTS[code].text
    return Report(EVENTS[code].level, code, text[:MAX_TEXT])


@dataclass(frozen=True, slots=True)
class Alarm:
    """A fault; one alarm of each ``kind`` at most, ``code`` is its cause."""

    kind: str
    level: str
    text: str
    code: str


def alarm_of(rule: Rule, state: Any, telemetry: Telemetry, was_there: bool) -> Alarm | None:
    """Return the alarm of a rule; ``was_there``: its condition was once known not to hold."""
    if not rule.alarm or not state or is_hidden(rule, telemetry):
        return None
    if state == AWAITED and not was_there:
        level = rule.awaited_level
        return Alarm(rule.alarm, level, rule.awaited_text, rule.awaited_code) if level else None
    if state == AWAITED and not rule.awaited_level:
        return None
    level = rule.level_armed if telemetry.flag("armed") else rule.level
    return Alarm(rule.alarm, level, rule.text, rule.code)


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


def silence(link: LinkSnapshot) -> Alarm | None:
    """Return the alarm of a link over which no current telemetry arrives, with its cause."""
    if not (link.was_heard and link.is_silent):
        return None
    report = event_of("late" if link.is_late else "silent")
    if not link.is_open:
        report = event_of("no_link", link.reason)
    elif link.is_aircraft_online is False:
        report = event_of("aircraft_offline")
    return Alarm("silent", ALARM, report.text, report.code)
