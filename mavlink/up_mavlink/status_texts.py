"""Events and alarms of telemetry as STATUSTEXT, by the rules of schema/."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import MODE_REASONS, RULES
from up.sanitize_text import sanitize_text
from up_mavlink.frame import Frame

SEVERITIES = {"alarm": 2, "warning": 4, "info": 6}
REFUSED = 4
PART_BYTES, MAX_PARTS = 50, 4
PAUSE_S = 3.0
"""A field that changes again sooner is reported with its newest value, after this time."""
_VALUE = re.compile(r"\{([^}]+)\}")


class StatusTexts:
    """Yields severity and text of each change; what holds at the first frame is reported once."""

    def __init__(self) -> None:
        self._states: dict[Rule, Any] = {}
        self._reported_s: dict[Rule, float] = {}

    def update(self, frame: Frame, now_s: float) -> Iterator[tuple[int, str]]:
        """Take a frame."""
        for rule in RULES:
            if not rule.event:
                continue
            before = self._states.get(rule)
            state = _state(rule, frame, before)
            if state is None or state == before:
                continue
            if now_s - self._reported_s.get(rule, -PAUSE_S) < PAUSE_S:
                continue
            self._states[rule] = state
            text = _text(rule, frame, before, state)
            if text:
                self._reported_s[rule] = now_s
                yield SEVERITIES[rule.level] if state else SEVERITIES["info"], text


def _state(rule: Rule, frame: Frame, before: Any) -> Any:
    path = rule.path.split(".")
    if rule.type == "text":
        return frame.text(*path) or ("" if rule.end else None)
    if rule.type == "texts":
        texts = frame.texts(*path)
        return None if texts is None else tuple(sorted(texts))
    value = frame.flag(*path) if rule.type == "flag" else frame.number(*path)
    holds = rule.holds(value, before is True)
    if holds and rule.awaits and before is None:
        ages = (frame.number("age_ms", reading) for reading in rule.awaits)
        return None if all(each is None for each in ages) else holds
    return holds


def _text(rule: Rule, frame: Frame, before: Any, now: Any) -> str:
    if not now and rule.end:
        return rule.end if before else ""
    if rule.type in ("flag", "number"):
        return _filled(rule.text, frame) if now else ""
    if before is None and rule.type == "text" and not rule.first:
        return ""
    shown = "; ".join(now) if rule.type == "texts" else MODE_REASONS.get(now, now)
    return _filled(rule.text, frame, value=shown, before=before) if now or before else ""


def _filled(text: str, frame: Frame, **known: object) -> str:
    def value(found: re.Match[str]) -> str:
        if found[1] in known:
            return str(known[found[1]])
        for path in (name.split(".") for name in found[1].split(" or ")):
            number = frame.number(*path)
            shown = frame.text(*path) if number is None else f"{number:.0f}"
            if shown is not None:
                return shown
        return "--"

    return _VALUE.sub(value, text)


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
