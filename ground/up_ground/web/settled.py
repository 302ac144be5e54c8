"""Debounces values: a change is reported, but not more often than a person can read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

FIRST_HOLD_S = 3.0
LONGEST_HOLD_S = 30.0
QUIET_S = 60.0

Told = Callable[[Any, Any], object]


@dataclass(slots=True)
class _Value:
    told: Any
    newest: Any
    tell: Told
    told_s: float
    hold_s: float = FIRST_HOLD_S


class Settled:
    """Reports a change immediately, the next one of the same key only after a growing pause.

    A flapping value is reported with its newest value, in the long run twice a minute. A key's
    first value is reported with None as the value before.
    """

    def __init__(self) -> None:
        self._values: dict[str, _Value] = {}

    def take(self, key: str, value: Any, now_s: float, tell: Told) -> None:
        """Take the present value; ``tell(before, now)`` is called when it is reported."""
        known = self._values.get(key)
        if known is None:
            self._values[key] = _Value(value, value, tell, now_s - QUIET_S)
            tell(None, value)
            return
        known.newest, known.tell = value, tell
        if value != known.told:
            self._try(known, now_s)

    def on_moment(self, now_s: float) -> None:
        """Report the changes whose pause is over."""
        for known in self._values.values():
            if known.newest != known.told:
                self._try(known, now_s)

    def _try(self, known: _Value, now_s: float) -> None:
        rest_s = now_s - known.told_s
        if rest_s < known.hold_s:
            return
        known.hold_s = FIRST_HOLD_S if rest_s >= QUIET_S else min(LONGEST_HOLD_S, known.hold_s * 2)
        before, known.told, known.told_s = known.told, known.newest, now_s
        known.tell(before, known.told)
