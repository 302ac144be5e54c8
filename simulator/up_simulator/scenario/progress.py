"""One line on a terminal with the progress of a flight."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from typing import TextIO

REFRESH_S = 0.2


class ProgressLine:
    """Rewrites one line of a terminal; silent if the output is not a terminal."""

    def __init__(
        self, stream: TextIO, is_shown: bool, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._stream = stream
        self._is_shown = is_shown and stream.isatty()
        self._clock = clock
        self._title = ""
        self._duration_s = 0.0
        self._began_s = 0.0
        self._shown_s = -REFRESH_S
        self._width = 0

    def begin(self, title: str, duration_s: float) -> None:
        self._title, self._duration_s = title, duration_s
        self._began_s = self._clock()
        self._shown_s = self._began_s - REFRESH_S
        self._write(f"{title}: booting")

    def show(self, time_s: float) -> None:
        """Show the time of the flight, five times a second at most."""
        now_s = self._clock()
        if not self._is_shown or now_s - self._shown_s < REFRESH_S:
            return
        self._shown_s = now_s
        speed = time_s / max(1e-3, now_s - self._began_s)
        of = f"{time_s:.1f} of {self._duration_s:g} s"
        self._write(f"{self._title}: {of}, {speed:.1f} x real time")

    def end(self) -> None:
        if self._is_shown and self._width:
            self._put("\r" + " " * self._width + "\r")
            self._width = 0

    def _write(self, text: str) -> None:
        if self._is_shown:
            padded = text.ljust(self._width)
            self._width = len(text)
            self._put("\r" + padded)

    def _put(self, text: str) -> None:
        # The terminal may be closed already, and the flight must still end in order.
        with suppress(OSError):
            self._stream.write(text)
            self._stream.flush()
