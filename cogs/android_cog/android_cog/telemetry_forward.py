"""Telemetry for the phone: seldom, and always the newest."""

from __future__ import annotations

from collections.abc import Callable

from up.commands.telemetry_commands import TelemetryCommand
from up.system.clock import Clock, Timer


class TelemetryForward:
    """Hands on at most one frame an interval, the newest that there is then."""

    def __init__(
        self, clock: Clock, interval_s: float, send: Callable[[TelemetryCommand], object]
    ) -> None:
        self._clock = clock
        self._interval_s = interval_s
        self._send = send
        self._newest: TelemetryCommand | None = None
        self._timer: Timer | None = None
        self.least_interval_s = 0.0
        """A longer interval while it is greater than the usual one (Panic Mode)."""

    def offer(self, frame: TelemetryCommand) -> None:
        """Hand the frame on now, or when the interval is over unless a newer one comes."""
        if self._timer is None:
            self._send_now(frame)
        else:
            self._newest = frame

    def forget(self) -> None:
        """Drop the frame that waits, and begin anew."""
        self._newest = None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _send_now(self, frame: TelemetryCommand) -> None:
        delay_s = max(self._interval_s, self.least_interval_s)
        self._timer = self._clock.callLater(delay_s, self._interval_over)
        self._send(frame)

    def _interval_over(self) -> None:
        self._timer = None
        newest, self._newest = self._newest, None
        if newest is not None:
            self._send_now(newest)
