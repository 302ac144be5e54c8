"""One line on a terminal with the progress of a flight."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TextIO

from up.output import StatusLine


class ProgressLine:
    """Silent if the output is not a terminal."""

    def __init__(
        self, stream: TextIO, is_shown: bool, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._line = StatusLine(stream, clock=clock) if is_shown else None
        self._clock = clock
        self._title = ""
        self._duration_s = 0.0
        self._began_s = 0.0

    def begin(self, title: str, duration_s: float) -> None:
        self._title, self._duration_s = title, duration_s
        self._began_s = self._clock()
        if self._line is not None:
            self._line.show(f"{title}: booting")

    def show(self, time_s: float) -> None:
        """Show the time of the flight, five times a second at most."""
        if self._line is not None:
            speed = time_s / max(1e-3, self._clock() - self._began_s)
            of = f"{time_s:.1f} of {self._duration_s:g} s"
            self._line.show(f"{self._title}: {of}, {speed:.1f} x real time")

    def end(self) -> None:
        if self._line is not None:
            self._line.clear()
