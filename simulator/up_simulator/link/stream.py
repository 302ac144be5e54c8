"""One direction of a connection over a link: in order, without loss, as the link permits."""

from __future__ import annotations

import enum
import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from up.system.clock import Clock, cancel
from up_simulator.link.model import LinkModel

SEGMENT = 1448
HEADER = 40
"""Bytes of an IPv4 and a TCP header, which a link carries too."""
MIN_RETRY_S, INITIAL_RETRY_S, MAX_RETRY_S = 0.2, 1.0, 120.0
MAX_RESET_RETRY_S = 1.0
"""A closed peer answers the next packet of the other side with a reset."""
POLL_S = 0.01
"""Period of the checks whether a stalled link has resumed."""
_TINY_S = 1e-9


class Signal(enum.Enum):
    """A connection's signals beside its bytes."""

    OPEN = "open"
    OPENED = "opened"
    FINISHED = "finished"
    RESET = "reset"


@dataclass(slots=True)
class _Packet:
    """A packet in flight, its arrival time (None: it is lost), and the blackouts before it."""

    content: bytes | Signal
    size: int
    sent_s: float
    due_s: float | None
    blackouts: int


class LinkStream:
    """Carries packets by a model and hands each to ``deliver`` when it has arrived.

    Lost packets are sent again, as TCP does: first after 0.2 s or two round trips, then each time
    after twice the interval, up to 120 s. ``is_blocked`` means that the receiver takes no more.
    ``on_silence`` is called when packets are in flight and none has arrived for
    ``user_timeout_s``.
    """

    def __init__(
        self,
        clock: Clock,
        model: LinkModel,
        deliver: Callable[[bytes | Signal], object],
        *,
        user_timeout_s: float | None = None,
        on_silence: Callable[[], object] = lambda: None,
    ) -> None:
        self._clock = clock
        self._model = model
        self._deliver = deliver
        self._user_timeout_s = user_timeout_s or math.inf
        self._on_silence = on_silence
        self._packets: deque[_Packet] = deque()
        self._timer: Any = None
        self._is_blocked = False
        self._is_stopped = False
        self._is_busy = False
        self._retry_s = INITIAL_RETRY_S
        self._retry_at_s = math.inf
        self._progress_s = clock.seconds()
        self.waiting = 0
        """Bytes on their way."""

    @property
    def is_blocked(self) -> bool:
        return self._is_blocked

    @is_blocked.setter
    def is_blocked(self, is_blocked: bool) -> None:
        self._is_blocked = is_blocked
        self._progress_s = self._clock.seconds()
        self._run()

    def send(self, content: bytes | Signal) -> None:
        """Send bytes or a signal; a reset overtakes packets in flight."""
        if self._is_stopped:
            return
        if not self._packets:
            self._progress_s = self._clock.seconds()
        if isinstance(content, Signal):
            if content is Signal.RESET:
                self._clear()
            self._append(content, 0)
        else:
            for at in range(0, len(content), SEGMENT):
                segment = content[at : at + SEGMENT]
                self._append(segment, len(segment))
        self._run()

    def stop(self) -> None:
        self._is_stopped = True
        self._clear()
        self._cancel()

    def _append(self, content: bytes | Signal, size: int) -> None:
        packet = _Packet(content, size, 0.0, None, 0)
        self._launch(packet, self._clock.seconds())
        self._packets.append(packet)
        self.waiting += size

    def _launch(self, packet: _Packet, now_s: float) -> None:
        packet.sent_s = now_s
        packet.due_s = self._model.send(packet.size + HEADER, now_s)
        packet.blackouts = self._model.blackouts

    def _clear(self) -> None:
        self._packets.clear()
        self.waiting = 0
        self._retry_at_s = math.inf

    def _has_vanished(self, packet: _Packet) -> bool:
        model = self._model
        return packet.due_s is None or model.is_black or packet.blackouts != model.blackouts

    def _run(self) -> None:
        """Deliver the arrived packets; packets that a delivery causes follow later."""
        if self._is_busy:
            return
        self._is_busy = True
        try:
            while self._packets and not self._is_blocked and self._deliver_first():
                pass
        finally:
            self._is_busy = False
        self._schedule()

    def _deliver_first(self) -> bool:
        now_s = self._clock.seconds()
        first = self._packets[0]
        if self._has_vanished(first):
            return self._is_sent_again(first, now_s)
        if first.due_s is None or self._model.arrival_s(first.due_s) > now_s + _TINY_S:
            return False
        self._packets.popleft()
        self.waiting -= first.size
        self._progress_s = now_s
        self._retry_s = max(MIN_RETRY_S, 4 * self._model.settings.delay_ms / 1000)
        self._retry_at_s = math.inf
        self._deliver(first.content)
        return True

    def _is_sent_again(self, first: _Packet, now_s: float) -> bool:
        if self._retry_at_s == math.inf:
            self._retry_at_s = max(now_s, first.sent_s + self._retry_s)
        if now_s < self._retry_at_s - _TINY_S:
            return False
        # The receiver keeps nothing beyond a gap: all packets go again.
        for packet in self._packets:
            self._launch(packet, now_s)
        if not self._has_vanished(first):
            self._retry_at_s = math.inf
            return True
        is_reset = first.content is Signal.RESET
        self._retry_s = min(2 * self._retry_s, MAX_RESET_RETRY_S if is_reset else MAX_RETRY_S)
        self._retry_at_s = now_s + self._retry_s
        return False

    def _schedule(self) -> None:
        self._cancel()
        if not self._packets or self._is_blocked or self._is_stopped:
            return
        now_s = self._clock.seconds()
        first = self._packets[0]
        if self._has_vanished(first) or first.due_s is None:
            next_s = self._retry_at_s
        else:
            next_s = self._model.arrival_s(first.due_s)
            if next_s == math.inf:
                next_s = now_s + POLL_S
        next_s = min(next_s, self._progress_s + self._user_timeout_s)
        self._timer = self._clock.callLater(max(0.0, next_s - now_s), self._on_timer)

    def _on_timer(self) -> None:
        self._timer = None
        self._run()
        silent_s = self._clock.seconds() - self._progress_s
        if self._packets and not self._is_blocked and silent_s >= self._user_timeout_s - _TINY_S:
            # Report a timeout only once; only a reset may be in flight then.
            self._user_timeout_s = math.inf
            self._on_silence()

    def _cancel(self) -> None:
        cancel(self._timer)
        self._timer = None
