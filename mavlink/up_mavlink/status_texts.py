"""Events and alarms of telemetry as STATUSTEXT, by the rules of schema/."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from up.commands.event_rules import report_of, state_of
from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import RULES
from up.sanitize_text import sanitize_text
from up.telemetry_frame import Frame

SEVERITIES = {"alarm": 2, "warning": 4, "info": 6}
REFUSED = 4
PART_BYTES, MAX_PARTS = 50, 4
PAUSE_S = 3.0
"""A field that changes again sooner is reported with its newest value, after this time."""


class StatusTexts:
    """Yields severity and text of each change; what holds at the first frame is reported once."""

    def __init__(self) -> None:
        self._states: dict[Rule, Any] = {}
        self._reported_s: dict[Rule, float] = {}

    def update(self, frame: Frame, now_s: float) -> Iterator[tuple[int, str]]:
        for rule in RULES:
            if not rule.event:
                continue
            before = self._states.get(rule)
            state = state_of(rule, frame, before)
            if state is None or state == before:
                continue
            if now_s - self._reported_s.get(rule, -PAUSE_S) < PAUSE_S:
                continue
            self._states[rule] = state
            report = report_of(rule, before, state, frame)
            if report is not None:
                self._reported_s[rule] = now_s
                yield SEVERITIES[report.level], report.text


def messages_of(m: Any, severity: int, text: str, number: int) -> list[Any]:
    """Return the messages of a text: one, or parts that a receiver joins by ``number``."""
    whole = sanitize_text(text, PART_BYTES * MAX_PARTS).encode("ascii", "replace")
    parts = [whole[at : at + PART_BYTES] for at in range(0, len(whole), PART_BYTES)]
    id_ = number % 65535 + 1 if len(parts) > 1 else 0
    if id_ and len(parts[-1]) == PART_BYTES:
        # A receiver recognises the last part by the zero at its end.
        parts.append(b"")
    return [
        m.MAVLink_statustext_message(severity, part, id_, place) for place, part in enumerate(parts)
    ]
