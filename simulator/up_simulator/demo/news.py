"""Selects the lines of the aircraft's log that ``make run`` prints immediately."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from up_simulator.harness.user_log import LogLine

CODES = ("crashed", "relaunched", "battery_changed", "phone_lost")
QUIET_S = 60.0


class News:
    """Selects lines; the lateness on a busy machine is reported at first, then once a minute.

    ``now_s`` is a monotonic clock.
    """

    def __init__(self, now_s: Callable[[], float]) -> None:
        self._now_s = now_s
        self._reported_s: float | None = None
        self._late_s = 0.0
        self._count = 0

    def select(self, lines: Iterable[LogLine]) -> list[str]:
        """Return the texts to print for new lines, and for those held back."""
        chosen = []
        for line in lines:
            if line.code in CODES:
                chosen.append(line.text)
            elif line.code == "late" and self._reported_s is None:
                self._reported_s = self._now_s()
                chosen.append(line.text)
            elif line.code == "late":
                self._late_s += float(line.fields["late_s"])
                self._count += 1
        is_due = self._reported_s is not None and self._now_s() - self._reported_s >= QUIET_S
        if self._count and is_due:
            times = "once" if self._count == 1 else f"{self._count} times"
            chosen.append(
                f"late {times} more, by {self._late_s:.2f} s in total: this machine is too busy,"
                " and the missed time is skipped, not flown"
            )
            self._reported_s, self._late_s, self._count = self._now_s(), 0.0, 0
        return chosen
