"""Switches panic by two thresholds and a dwell time."""

from __future__ import annotations

SMOOTHING_S = 2.0


class PanicSwitch:
    """Turns a noisy load (percent) into rare switches.

    The load is smoothed over ``SMOOTHING_S``; two switches are at least ``dwell_s`` apart.
    """

    def __init__(self, panic_percent: float, calm_percent: float, dwell_s: float) -> None:
        self.is_on = False
        self.load_percent: float | None = None
        self._panic_percent = panic_percent
        self._calm_percent = calm_percent
        self._dwell_s = dwell_s
        self._seen_at_s = 0.0
        self._switched_at_s = float("-inf")

    def update(self, load_percent: float, now_s: float) -> bool:
        """Take a measurement; return whether panic was switched, either way."""
        if self.load_percent is None:
            self.load_percent = load_percent
        else:
            part = min(1.0, (now_s - self._seen_at_s) / SMOOTHING_S)
            self.load_percent += (load_percent - self.load_percent) * part
        self._seen_at_s = now_s
        if now_s - self._switched_at_s < self._dwell_s:
            return False
        wanted = self.load_percent >= self._panic_percent
        if self.is_on:
            wanted = self.load_percent > self._calm_percent
        if wanted == self.is_on:
            return False
        self.is_on = wanted
        self._switched_at_s = now_s
        return True
