"""Telemetry for the phone, at a low rate, always the newest frame."""

from collections.abc import Callable

from up.commands.telemetry_commands import TelemetryCommand
from up.system.clock import Clock, Timer


class TelemetryForward:
    """Forwards at most one frame per interval, the newest one."""

    def __init__(
        self, clock: Clock, interval_s: float, send: Callable[[TelemetryCommand], object]
    ) -> None:
        self._clock = clock
        self._interval_s = interval_s
        self._send = send
        self._newest: TelemetryCommand | None = None
        self._timer: Timer | None = None
        self.min_interval_s = 0.0
        """A longer interval, used while it exceeds the usual one (Panic Mode)."""

    def offer(self, frame: TelemetryCommand) -> None:
        """Forward the frame now, or at the end of the interval unless a newer one replaces it."""
        if self._timer is None:
            self._send_now(frame)
        else:
            self._newest = frame

    def discard(self) -> None:
        """Drop the waiting frame and restart the interval."""
        self._newest = None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _send_now(self, frame: TelemetryCommand) -> None:
        delay_s = max(self._interval_s, self.min_interval_s)
        self._timer = self._clock.callLater(delay_s, self._on_interval)
        self._send(frame)

    def _on_interval(self) -> None:
        self._timer = None
        newest, self._newest = self._newest, None
        if newest is not None:
            self._send_now(newest)
