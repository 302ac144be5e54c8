"""Events and alarms of an aircraft."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from up_ground.telemetry import Telemetry
from up_ground.web.event_rules import (
    ALARM,
    ALARM_HOLD_S,
    EVENT_RULES,
    INFO,
    WARNING,
    Alarms,
    EventRule,
    LinkSnapshot,
)

INITIAL_HOLD_S = 3.0
MAX_HOLD_S = 30.0
QUIET_S = 60.0

Reported = Callable[[Any, Any], object]


@dataclass(slots=True)
class _Value:
    reported: Any
    newest: Any
    notify: Reported
    reported_s: float
    hold_s: float = INITIAL_HOLD_S


class Debouncer:
    """Reports a change immediately, the next one of the same key only after a growing pause.

    A flapping value is reported with its newest value, in the long run twice a minute. A key's
    first value is reported with None as the value before.
    """

    def __init__(self) -> None:
        self._values: dict[str, _Value] = {}

    def update(self, key: str, value: Any, now_s: float, notify: Reported) -> None:
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
        known.hold_s = INITIAL_HOLD_S if rest_s >= QUIET_S else min(MAX_HOLD_S, known.hold_s * 2)
        before, known.reported, known.reported_s = known.reported, known.newest, now_s
        known.notify(before, known.reported)


EVENTS_KEPT = 200


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened; ``at_s`` is the clock's, on the ground."""

    number: int
    at_s: float
    level: str
    kind: str
    text: str

    def message(self, aircraft: str, now_s: float, is_past: bool) -> dict[str, Any]:
        """Return the message for the pages."""
        fields: dict[str, Any] = {
            "type": "event",
            "aircraft": aircraft,
            "number": self.number,
            "age_ms": round(max(0.0, now_s - self.at_s) * 1000),
            "level": self.level,
            "kind": self.kind,
            "text": self.text,
        }
        if is_past:
            fields["is_past"] = True
        return fields


class EventMonitor:
    """Takes frames and link states, reports each change once and debounces values that flap.

    ``notify`` gets the messages for the pages. An alarm ends ``hold_s`` after its cause.
    """

    def __init__(
        self,
        aircraft: str,
        notify: Callable[[dict[str, Any]], object],
        hold_s: float = ALARM_HOLD_S,
    ) -> None:
        self._aircraft = aircraft
        self._notify = notify
        self._events: deque[Event] = deque(maxlen=EVENTS_KEPT)
        self._debouncer = Debouncer()
        self._alarms = Alarms(hold_s)
        self._number = 0

    def report(self, kind: str, level: str, text: str, now_s: float, late_s: float = 0.0) -> None:
        """Report an event of ``late_s`` ago."""
        self._number += 1
        event = Event(self._number, now_s - late_s, level, kind, text)
        self._events.append(event)
        self._notify(event.message(self._aircraft, now_s, is_past=False))

    def on_frame(self, telemetry: Telemetry, link: LinkSnapshot, now_s: float) -> None:
        """Process a new frame."""
        for rule in EVENT_RULES:
            value = rule.read(telemetry)
            if value is not None:
                self._debouncer.update(rule.key, value, now_s, partial(self._apply, rule, now_s))
        self.on_moment(telemetry, link, now_s)

    def on_link(self, link: LinkSnapshot, now_s: float) -> None:
        """Process the state of the link."""
        state: tuple[bool, bool | None] = (link.is_open, link.is_aircraft_online)

        def on_change(before: Any, now: Any) -> None:
            level, text = _link_words(link, before, now)
            if text:
                self.report("link", level, text, now_s)

        self._debouncer.update("link", state, now_s, on_change)

    def on_moment(self, telemetry: Telemetry, link: LinkSnapshot, now_s: float) -> None:
        """Process the changes by time alone."""
        self._debouncer.on_moment(now_s)
        if self._alarms.update(telemetry, link, now_s):
            kinds = {each.kind for each in self._alarms.active}
            silence = "telemetry comes too late" if link.is_late else "no telemetry any more"
            for kind, gone, back in (
                ("silent", silence, "telemetry comes again"),
                ("battery", "the phone's battery is low", "the phone's battery is charged"),
            ):
                self._report_alarm(kind, kind in kinds, gone, back, now_s)
            self._notify(self._alarms.message(self._aircraft))

    def past(self, now_s: float) -> Iterator[dict[str, Any]]:
        """Yield the messages for a page that joins later."""
        for event in self._events:
            yield event.message(self._aircraft, now_s, is_past=True)
        yield self._alarms.message(self._aircraft)

    def _apply(self, rule: EventRule, now_s: float, before: Any, now: Any) -> None:
        said = rule.words(before, now)
        if said is not None:
            self.report(rule.kind, said[0], said[1], now_s)

    def _report_alarm(self, kind: str, is_on: bool, gone: str, back: str, now_s: float) -> None:
        def on_change(before: Any, now: Any) -> None:
            if now:
                self.report(_KINDS[kind], ALARM if kind == "silent" else WARNING, gone, now_s)
            elif before is not None:
                self.report(_KINDS[kind], INFO, back, now_s)

        self._debouncer.update(f"alarm {kind}", is_on, now_s, on_change)


_KINDS = {"silent": "link", "battery": "battery"}


def _link_words(link: LinkSnapshot, before: Any, now: Any) -> tuple[str, str]:
    is_open, is_online = now
    if not is_open:
        if before is None:
            return INFO, ""
        return WARNING, f"the link to the proxy is gone: {link.reason}"[:300]
    if is_online is False:
        return WARNING, "the aircraft is not connected to the proxy"
    if is_online:
        return INFO, "the aircraft is connected"
    return INFO, "the link is there"
