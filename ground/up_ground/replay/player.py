"""Plays a flight: which frame is due, at which speed, from where."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from up.system.clock import Clock, Timer, cancel
from up_flightlog.read.telemetry_frames import Frame

MIN_SPEED, MAX_SPEED = 0.25, 64.0
MIN_PAUSE_S = 0.04
"""Faster frames are thinned out: they could not be seen."""
MAX_PAUSE_S = 0.1
REPEAT_S = 0.2
"""Without a newer frame the last one is shown again in this period, with its age in the flight."""

Open = Callable[[float], Iterator[Frame]]


class Player:
    """Plays the frames that ``open_at(time_s)`` yields, from that time on.

    ``show(frame)`` gets the newest frame that is due, ``moved(before_s, now_s)`` the progress,
    ``changed()`` is called when it plays, pauses or jumps.
    """

    def __init__(
        self,
        clock: Clock,
        length_s: float,
        open_at: Open,
        *,
        show: Callable[[Frame], object],
        moved: Callable[[float, float], object],
        changed: Callable[[], object],
    ) -> None:
        self.length_s = length_s
        self.speed = 1.0
        self.is_playing = False
        self._clock = clock
        self._open_at = open_at
        self._show = show
        self._moved = moved
        self._changed = changed
        self._frames = open_at(0.0)
        self._next: Frame | None = next(self._frames, None)
        self._shown: Frame | None = None
        self._shown_at_s = 0.0
        self._from_s = 0.0
        self._since_s = clock.seconds()
        self._reported_s = 0.0
        self._timer: Timer | None = None

    @property
    def time_s(self) -> float:
        if not self.is_playing:
            return self._from_s
        gone_s = (self._clock.seconds() - self._since_s) * self.speed
        return min(self.length_s, self._from_s + gone_s)

    def play(self) -> None:
        """Resume, from the beginning when the end was reached."""
        if self.is_playing:
            return
        if self._from_s >= self.length_s:
            self.seek(0.0)
        self.is_playing = True
        self._since_s = self._clock.seconds()
        self._changed()
        self._advance()

    def pause(self) -> None:
        self._freeze()
        self.is_playing = False
        self._changed()

    def seek(self, time_s: float) -> None:
        self._freeze()
        self._from_s = self._reported_s = max(0.0, min(self.length_s, time_s))
        self._frames = self._open_at(self._from_s)
        self._next = next(self._frames, None)
        self._changed()
        # In a silence the last frame before it is what a page saw.
        shown = self._due(self._from_s) or self._next
        self._shown = None
        if shown is not None:
            self._show_now(shown)
        if self.is_playing:
            self._advance()

    def set_speed(self, speed: float) -> None:
        """Raises ValueError for a speed out of range."""
        if not MIN_SPEED <= speed <= MAX_SPEED:
            raise ValueError(f"the speed must be {MIN_SPEED:g} to {MAX_SPEED:g}")
        self._freeze()
        self.speed = speed
        self._changed()
        if self.is_playing:
            self._advance()

    def stop(self) -> None:
        self.is_playing = False
        cancel(self._timer)

    def _freeze(self) -> None:
        cancel(self._timer)
        self._from_s = self.time_s
        self._since_s = self._clock.seconds()

    def _advance(self) -> None:
        now_s = self.time_s
        due = self._due(now_s)
        before_s, self._reported_s = self._reported_s, now_s
        self._moved(before_s, now_s)
        if due is not None:
            self._show_now(due)
        elif self._shown is not None and self._clock.seconds() - self._shown_at_s >= REPEAT_S:
            self._show_now(self._shown)
        if now_s >= self.length_s:
            self.pause()
            return
        rest_s = self.length_s if self._next is None else self._next.time_s
        pause_s = (rest_s - now_s) / self.speed
        pause_s = max(MIN_PAUSE_S, min(MAX_PAUSE_S, pause_s))
        self._timer = self._clock.callLater(pause_s, self._advance)

    def _show_now(self, frame: Frame) -> None:
        self._shown, self._shown_at_s = frame, self._clock.seconds()
        self._show(frame)

    def _due(self, now_s: float) -> Frame | None:
        """Return the newest frame before a time that was not shown yet."""
        due = None
        while self._next is not None and self._next.time_s <= now_s + 1e-6:
            due, self._next = self._next, next(self._frames, None)
        return due
