"""Estimates the transit delay of messages by their sender's clock."""

from __future__ import annotations

from up.commands.telemetry_schema import DRIFT, NEW_CLOCK_S

_SAME_CLOCK_S = 1.0


class OneWayDelayEstimator:
    """Estimates how much longer a message was under way than the quickest one.

    The two clocks need no common zero: the delay of the quickest message is excluded from every
    figure. The minimum is forgotten only at the rate of the clock drift, so that a queue that
    stands for minutes does not count as transit time: after a time t the figure is too small by
    up to 2 t ``DRIFT``, and never too great. A clock that steps back, or falls behind by
    ``NEW_CLOCK_S`` in one step, counts as a new clock and resets the estimate.
    """

    def __init__(self) -> None:
        self.has_begun = False
        """Whether the last message was the first of its clock."""
        self._is_trusted = False
        self._least_s: float | None = None
        self._excess_s = 0.0
        self._stamp_s = 0.0
        self._now_s = 0.0

    def reset(self) -> None:
        if not self._is_trusted:
            self._least_s = None

    def trust(self, stamp_ms: float, from_s: float, to_s: float) -> None:
        """Take an authentic reading of the sender's clock, made between two times here.

        From now on only another one counts as a new clock: messages that are held back show it.
        An estimate that this reading permits stays, so that a slow reading spoils no quick one.
        """
        stamp_s = stamp_ms / 1000
        low_s, high_s = from_s - stamp_s, to_s - stamp_s
        known_s = self._least_s if self._is_trusted else None
        if known_s is None or not low_s - _SAME_CLOCK_S < known_s < high_s + _SAME_CLOCK_S:
            known_s = (low_s + high_s) / 2
        self._is_trusted = True
        self._least_s = min(max(known_s, low_s), high_s)
        self._stamp_s, self._now_s = stamp_s, to_s

    def update(self, stamp_ms: float | None, now_s: float) -> float | None:
        """Take a message that arrives now; return its delay in seconds.

        ``stamp_ms`` is the sender's clock at departure; None: unknown.
        """
        self.has_begun = False
        if stamp_ms is None:
            return None
        stamp_s = stamp_ms / 1000
        apart_s = now_s - stamp_s
        if self._least_s is not None:
            least_s = min(apart_s, self._least_s + DRIFT * (now_s - self._now_s))
            has_jumped = apart_s - least_s > self._excess_s + NEW_CLOCK_S
            is_new = not self._is_trusted and (stamp_s < self._stamp_s or has_jumped)
            self._least_s = None if is_new else least_s
        if self._least_s is None:
            self.has_begun = True
            self._least_s = apart_s
        self._stamp_s, self._now_s = stamp_s, now_s
        self._excess_s = apart_s - self._least_s
        return self._excess_s
