"""Sends a value on change, at a limited rate."""

from collections.abc import Callable

from up.system.clock import Clock, Timer

MIN_PERIOD_S = 0.1


class OnChangeSender:
    """Sends the newest payload, at most ten times a second and only when it differs.

    A payload offered too early waits, and only the newest waits. ``send`` returns None for a
    payload that was not sent; the next offer sends it again.
    """

    def __init__(self, clock: Clock, send: Callable[[bytes], object]) -> None:
        self._clock = clock
        self._send = send
        self._sent: bytes | None = None
        self._sent_s = float("-inf")
        self._waiting: bytes | None = None
        self._timer: Timer | None = None

    def offer(self, payload: bytes) -> None:
        if self._timer is not None:
            self._waiting = payload
            return
        if payload == self._sent:
            return
        wait_s = self._sent_s + MIN_PERIOD_S - self._clock.seconds()
        if wait_s > 0:
            self._waiting = payload
            self._timer = self._clock.callLater(wait_s, self._waited)
            return
        self._sent_s = self._clock.seconds()
        self._sent = payload if self._send(payload) is not None else None

    def reset(self) -> None:
        """Discard the sent and the waiting payload: the next offer is sent to any board."""
        self._sent = None
        self.stop()

    def stop(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = self._waiting = None

    def _waited(self) -> None:
        self._timer = None
        payload, self._waiting = self._waiting, None
        if payload is not None:
            self.offer(payload)
