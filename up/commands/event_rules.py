"""Applies the rules of schema/ for events to values of telemetry."""

import re
from collections.abc import Mapping
from dataclasses import field
from typing import Any, Protocol

from up.commands.schema_rows import Rule
from up.quick_dataclass import dataclass

INFO, WARNING, ALARM = "info", "warning", "alarm"
AWAITED = "awaited"
"""State of a part that was never connected and never reported anything: it is not lost."""
MAX_TEXT = 400
UNKNOWN = "--"
_VALUE = re.compile(r"\{([^}]+)\}")


class Values(Protocol):
    """A frame of telemetry by the paths of its fields; None: unknown, or of another type."""

    def number(self, *path: str) -> float | None: ...

    def flag(self, *path: str) -> bool | None: ...

    def text(self, *path: str) -> str | None: ...

    def texts(self, *path: str) -> list[str] | None: ...

    def is_null(self, *path: str) -> bool:
        """Return whether the aircraft reports null."""


@dataclass(frozen=True, slots=True)
class Report:
    """Level, code and text of an event; ``fields`` are its values."""

    level: str
    code: str
    text: str
    fields: Mapping[str, Any] = field(default_factory=dict)


def state_of(rule: Rule, telemetry: Values, before: Any) -> Any:
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


def is_hidden(rule: Rule, telemetry: Values) -> bool:
    """Return whether the condition `unless` of a rule hides its alarm."""
    return bool(rule.unless) and telemetry.flag(*rule.unless.split(".")) is True


def report_of(rule: Rule, before: Any, now: Any, telemetry: Values) -> Report | None:
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
    return Report(rule.level, rule.code, text[:MAX_TEXT], fields)


def fill(text: str, telemetry: Values, **known: object) -> str:
    """Return a text of schema/ with its values: ``{value}``, ``{a.field or another}``."""

    def value(found: re.Match[str]) -> str:
        if found[1] in known:
            return str(known[found[1]])
        for path in (name.split(".") for name in found[1].split(" or ")):
            number = telemetry.number(*path)
            shown = telemetry.text(*path) if number is None else str(round(number))
            if shown is not None:
                return shown
        return UNKNOWN

    return _VALUE.sub(value, text)
