"""The active gains, and the record of their changes."""

from __future__ import annotations

from collections import deque
from typing import Any

KEPT = 50


class GainsHistory:
    """The aircraft's last report of its gains, and the sets that pages of this server sent."""

    def __init__(self) -> None:
        self.flying: dict[str, Any] | None = None
        self._reported_s: float | None = None
        self._changes: deque[tuple[float, dict[str, Any]]] = deque(maxlen=KEPT)
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
        sent = {"by": by, "before": before, "after": after, "outcome": outcome, "reason": reason}
        self._changes.append((now_s, {"number": self._number, **sent}))

    def message(self, aircraft: str, now_s: float) -> dict[str, Any]:
        age_ms = None if self._reported_s is None else round((now_s - self._reported_s) * 1000)
        return {
            "type": "gains",
            "aircraft": aircraft,
            "flying": self.flying,
            "age_ms": age_ms,
            "history": [
                {**change, "age_s": round(now_s - at_s, 1)} for at_s, change in self._changes
            ],
        }
