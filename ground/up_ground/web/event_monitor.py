"""Events and alarms of an aircraft."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from up.commands.event_rules import Report, report_of, state_of
from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import (
    ALARM_HOLDS_S,
    MAX_PAUSE_S,
    PAUSE_S,
    QUIET_S,
    RULES,
)
from up_ground.telemetry import Telemetry
from up_ground.web.event_rules import (
    Alarm,
    LinkSnapshot,
    alarm_of,
    event_of,
    silence,
)

EVENTS_KEPT = 200

OnChange = Callable[[Any, Any], object]


@dataclass(slots=True)
class _Value:
    reported: Any
    newest: Any
    notify: OnChange
    reported_s: float
    hold_s: float = PAUSE_S


class Debouncer:
    """Reports a change immediately, the next one of the same key only after a growing pause.

    A flapping value is reported with its newest value, in the long run twice a minute. A key's
    first value is reported with None as the value before.
    """

    def __init__(self) -> None:
        self._values: dict[str, _Value] = {}

    def update(self, key: str, value: Any, now_s: float, notify: OnChange) -> None:
        """Take the present value; ``notify(before, now)`` is called when it is reported."""
        known = self._values.get(key)
        if known is None:
            self._values[key] = _Value(value, value, notify, now_s - QUIET_S)
            notify(None, value)
            return
        known.newest, known.notify = value, notify
        if value != known.reported:
            self._try(known, now_s)

    def on_moment(self, now_s: float) -> None:
        """Report the changes whose pause is over."""
        for known in self._values.values():
            if known.newest != known.reported:
                self._try(known, now_s)

    def _try(self, known: _Value, now_s: float) -> None:
        rest_s = now_s - known.reported_s
        if rest_s < known.hold_s:
            return
        known.hold_s = PAUSE_S if rest_s >= QUIET_S else min(MAX_PAUSE_S, known.hold_s * 2)
        before, known.reported, known.reported_s = known.reported, known.newest, now_s
        known.notify(before, known.reported)


class Alarms:
    """The active alarms. One begins immediately and ends ``hold_s`` after its cause.

    None: after the time that schema/ gives.
    """

    def __init__(self, hold_s: float | None = None) -> None:
        self._hold_s = hold_s
        self.active: tuple[Alarm, ...] = ()
        self._seen_s: dict[str, float] = {}
        self._known: dict[str, Alarm] = {}

    def update(self, present: Iterable[Alarm], now_s: float) -> bool:
        """Update to this moment; return whether the alarms changed."""
        found = {each.kind: each for each in present}
        self._known.update(found)
        self._seen_s.update(dict.fromkeys(found, now_s))
        for kind, seen_s in list(self._seen_s.items()):
            hold_s = ALARM_HOLDS_S[kind] if self._hold_s is None else self._hold_s
            if kind not in found and now_s - seen_s >= hold_s:
                del self._seen_s[kind], self._known[kind]
        known = tuple(self._known[kind] for kind in ALARM_HOLDS_S if kind in self._known)
        before, self.active = self.active, known
        return self.active != before

    def rows(self) -> list[dict[str, str]]:
        return [
            {"kind": each.kind, "code": each.code, "level": each.level, "text": each.text}
            for each in self.active
        ]

    def message(self, aircraft: str) -> dict[str, Any]:
        return {"type": "alarms", "aircraft": aircraft, "active": self.rows()}


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened; ``at_s`` is the clock's, on the ground."""

    number: int
    at_s: float
    kind: str
    report: Report

    def message(self, aircraft: str, now_s: float, is_past: bool) -> dict[str, Any]:
        return {
            "type": "event",
            "aircraft": aircraft,
            "number": self.number,
            "age_ms": round(max(0.0, now_s - self.at_s) * 1000),
            "level": self.report.level,
            "kind": self.kind,
            "code": self.report.code,
            "fields": self.report.fields,
            "text": self.report.text,
            **({"is_past": True} if is_past else {}),
        }


class EventMonitor:
    """Takes frames and link states, reports each change once and debounces values that flap.

    ``notify`` gets the messages for the pages. An alarm ends ``hold_s`` after its cause.
    """

    def __init__(
        self,
        aircraft: str,
        notify: Callable[[dict[str, Any]], object],
        hold_s: float | None = None,
    ) -> None:
        self._aircraft = aircraft
        self._notify = notify
        self._events: deque[Event] = deque(maxlen=EVENTS_KEPT)
        self._debouncer = Debouncer()
        self._alarms = Alarms(hold_s)
        self._states: dict[Rule, Any] = {}
        self._were_there: set[Rule] = set()
        self._number = 0

    def alarm_rows(self) -> list[dict[str, str]]:
        return self._alarms.rows()

    def report(self, kind: str, report: Report | None, now_s: float) -> None:
        if report is not None:
            self._number += 1
            event = Event(self._number, now_s, kind, report)
            self._events.append(event)
            self._notify(event.message(self._aircraft, now_s, is_past=False))

    def on_link(self, link: LinkSnapshot, now_s: float) -> None:
        state: tuple[bool, bool | None] = (link.is_open, link.is_aircraft_online)

        def on_change(before: Any, now: Any) -> None:
            self.report("link", _link_report(link, before, now), now_s)

        self._debouncer.update("link", state, now_s, on_change)

    def update(self, telemetry: Telemetry, link: LinkSnapshot, now_s: float) -> None:
        """Process a frame, or the changes by time alone."""
        alarms = [silence(link)]
        active = {each.kind for each in self._alarms.active}
        for rule in RULES:
            before = None if rule.alarm and rule.alarm not in active else self._states.get(rule)
            state = state_of(rule, telemetry, before)
            if state is None:
                continue
            self._states[rule] = state
            if state is False:
                self._were_there.add(rule)
            alarms.append(alarm_of(rule, state, telemetry, rule in self._were_there))
            if rule.event:
                notify = partial(self._apply, rule, telemetry, now_s)
                self._debouncer.update(f"{rule.path} {rule.code}", state, now_s, notify)
        self._debouncer.on_moment(now_s)
        if self._alarms.update(filter(None, alarms), now_s):
            is_silent = any(each.kind == "silent" for each in self._alarms.active)
            self._debouncer.update(
                "silent", is_silent, now_s, partial(self._on_silence, link, now_s)
            )
            self._notify(self._alarms.message(self._aircraft))

    def past(self, now_s: float) -> Iterator[dict[str, Any]]:
        for event in self._events:
            yield event.message(self._aircraft, now_s, is_past=True)
        yield self._alarms.message(self._aircraft)

    def _apply(self, rule: Rule, telemetry: Telemetry, now_s: float, before: Any, now: Any) -> None:
        self.report(rule.event, report_of(rule, before, now, telemetry), now_s)

    def _on_silence(self, link: LinkSnapshot, now_s: float, before: Any, now: Any) -> None:
        cause = silence(link)
        if now and cause is not None:
            self.report("link", event_of(cause.code), now_s)
        elif not now and before is not None:
            self.report("link", event_of("heard"), now_s)


def _link_report(link: LinkSnapshot, before: Any, now: tuple[bool, bool | None]) -> Report | None:
    is_open, is_online = now
    if not is_open:
        return None if before is None else event_of("link_lost", link.reason)
    if is_online is False:
        return event_of("aircraft_offline")
    return event_of("aircraft_online" if is_online else "link_open")
