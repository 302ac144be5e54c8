"""Selects the lines of the aircraft's output that ``make run`` prints immediately."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

NEWS = ("hit the ground", "broke in the air", "lost itself", "given up", "launched again",
        "battery", "the phone is gone")  # fmt: skip
QUIET_S = 60.0
_LATE = re.compile(r"late by ([0-9]+(?:\.[0-9]+)?) s")


class News:
    """Selects lines; the lateness on a busy machine is reported at first, then once a minute.

    ``now_s`` is a monotonic clock.
    """

    def __init__(self, now_s: Callable[[], float]) -> None:
        self._now_s = now_s
        self._said_s: float | None = None
        self._late_s = 0.0
        self._times = 0

    def of(self, lines: Iterable[str]) -> list[str]:
        """Return the lines to print for new lines, and for those held back."""
        chosen = []
        for line in lines:
            late = _LATE.search(line)
            if late is None:
                if any(words in line for words in NEWS):
                    chosen.append(line)
            elif self._said_s is None:
                self._said_s = self._now_s()
                chosen.append(line)
            else:
                self._late_s += float(late[1])
                self._times += 1
        if self._times and self._said_s is not None and self._now_s() - self._said_s >= QUIET_S:
            times = "once" if self._times == 1 else f"{self._times} times"
            chosen.append(
                f"late {times} more, by {self._late_s:.2f} s in all: this machine is too busy, and"
                " the missed time is skipped, not flown"
            )
            self._said_s, self._late_s, self._times = self._now_s(), 0.0, 0
        return chosen
