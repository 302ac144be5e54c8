"""Applies the rules of schema/ for events and alarms to telemetry and the link."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import EVENTS
from up_ground.status_text import fill
from up_ground.telemetry import Telemetry

INFO, WARNING, ALARM = "info", "warning", "alarm"
AWAITED = "awaited"
"""State of a part that was never connected and never reported anything: it is not lost."""
_MAX_TEXT = 400


@dataclass(frozen=True, slots=True)
class Report:
    """Level, code and text of an event; ``fields`` are its values."""

    level: str
    code: str
    text: str
    fields: Mapping[str, Any] = field(default_factory=dict)


def event_of(code: str, reason: str = "") -> Report:
    """Return an event that does not depend on telemetry (schema/events.yml)."""
    text = f"{EVENTS[code].text}: {reason}" if reason else EVENTS[code].text
    return Report(EVENTS[code].level, code, text[:_MAX_TEXT])


def state_of(rule: Rule, telemetry: Telemetry, before: Any) -> Any:
    """Return the value or the condition of a rule; None (unknown) does not count as a change."""
    path = rule.path.split(".")
    if rule.type == "text":
        # Where a rule has an end, null is it; an absent field stays unknown.
        is_over = bool(rule.end) and telemetry.is_null(*path)
        return "" if is_over else telemetry.text(*path)
    if rule.type == "texts":
        texts = telemetry.texts(*path)
        return None if texts is None else tuple(sorted(texts))
    value = telemetry.flag(*path) if rule.type == "flag" else telemetry.number(*path)
    state = rule.holds(value, before is True)
    if state and rule.awaits:
        ages_ms = (telemetry.number("age_ms", reading) for reading in rule.awaits)
        return AWAITED if all(age_ms is None for age_ms in ages_ms) else state
    return state


def report_of(rule: Rule, before: Any, now: Any, telemetry: Telemetry) -> Report | None:
    """Return the report of a change, None for no event; ``before`` is None for the first value."""
    end = Report(INFO, rule.end_code, rule.end) if rule.end else None
    if rule.type in ("flag", "number"):
        if now == AWAITED and before is not False:
            awaited = Report(INFO, rule.awaited_code, rule.awaited_text)
            return awaited if before is None else None
        if now:
            return Report(rule.level, rule.code, fill(rule.text, telemetry))
        return end if before else None
    if not now and rule.end:
        return end if before else None
    if before is None and rule.type == "text" and not rule.first:
        return None
    fields = {"value": now} if rule.first else {"value": now, "before": before}
    if rule.type == "texts":
        fields, now = {"value": list(now)}, "; ".join(now)
    text = fill(rule.text, telemetry, value=now, before=before)
    return Report(rule.level, rule.code, text[:_MAX_TEXT], fields)


@dataclass(frozen=True, slots=True)
class Alarm:
    """A fault; one alarm of each ``kind`` at most, ``code`` is its cause."""

    kind: str
    level: str
    text: str
    code: str


def alarm_of(rule: Rule, state: Any, telemetry: Telemetry, was_there: bool) -> Alarm | None:
    """Return the alarm of a rule; ``was_there``: its condition was once known not to hold."""
    is_hidden = rule.unless and telemetry.flag(*rule.unless.split("."))
    if not rule.alarm or not state or is_hidden:
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
