"""The active gains, and the record of their changes."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

KEPT = 50


@dataclass(frozen=True, slots=True)
class _Change:
    number: int
    at_s: float
    by: str
    before: dict[str, Any] | None
    after: dict[str, Any]
    outcome: str
    reason: str


class GainsHistory:
    """The aircraft's last report of its gains, and the sets that pages of this server sent."""

    def __init__(self) -> None:
        self.flying: dict[str, Any] | None = None
        self._reported_s: float | None = None
        self._changes: deque[_Change] = deque(maxlen=KEPT)
        self._number = 0

    def on_values(self, values: dict[str, Any], now_s: float) -> None:
        self.flying = values
        self._reported_s = now_s

    def record(
        self,
        by: str,
        before: dict[str, Any] | None,
        after: dict[str, Any],
        outcome: str,
        reason: str,
        now_s: float,
    ) -> None:
        self._number += 1
        change = _Change(self._number, now_s, by, before, after, outcome, reason)
        self._changes.append(change)

    def message(self, aircraft: str, now_s: float) -> dict[str, Any]:
        age_ms = None if self._reported_s is None else round((now_s - self._reported_s) * 1000)
        return {
            "type": "gains",
            "aircraft": aircraft,
            "flying": self.flying,
            "age_ms": age_ms,
            "history": [
                {
                    "number": each.number,
                    "age_s": round(now_s - each.at_s, 1),
                    "by": each.by,
                    "before": each.before,
                    "after": each.after,
                    "outcome": each.outcome,
                    "reason": each.reason,
                }
                for each in self._changes
            ],
        }
