"""A system's TCP for one end of a connection: order, acknowledgement, timeouts."""

from __future__ import annotations

from collections import deque
from typing import Any, Protocol

from twisted.internet.base import DelayedCall
from twisted.internet.error import ConnectionLost

from up_simulator.in_process.network import Route
from up_simulator.in_process.socket_options import SocketOptions

HEADER = 40
"""Bytes of an IPv4 and a TCP header, which a link carries too."""
SEGMENT = 1448
WINDOW = 10 * SEGMENT
"""Bytes on their way at most (RFC 6928); the rest waits where its program can replace it."""
READ_LIMIT = 65536
FIRST_RETRY_S, LEAST_RETRY_S, LONGEST_RETRY_S = 1.0, 0.2, 120.0
GIVE_UP_S = 924.0
"""Without a user timeout (Linux: 15 retries)."""

_Item = tuple[int, bytes, bool, float]


class Owner(Protocol):
    """Who uses the connection: a transport."""

    def on_established(self) -> None:
        """The connection is there."""

    def on_bytes(self, data: bytes) -> None:
        """Handle bytes, in order."""

    def on_eof(self) -> None:
        """The other side sends no more."""

    def on_lost(self, error: Exception) -> None:
        """The connection broke."""

    def on_room(self) -> None:
        """More can be written."""


class TcpEnd:
    """One end; ``peer`` is the other, which is only reached through the route.

    Unacknowledged data is sent again. A connection ends by a FIN, by a reset, or by silence:
    TCP_USER_TIMEOUT for unacknowledged bytes, keepalive for an idle one.
    """

    def __init__(self, clock: Any, route: Route) -> None:
        self.options = SocketOptions()
        self.owner: Owner | None = None
        self.is_closed = False
        self.peer: TcpEnd
        self._clock = clock
        self._route = route
        self._is_established = False
        self._sent = 0
        self._unacknowledged: deque[_Item] = deque()
        self._in_flight = 0
        self._is_finished = False
        self._expected = 0
        self._is_reading = True
        self._unread: list[bytes] = []
        self._unread_size = 0
        self._is_eof = False
        self._heard_s = self._progress_s = clock.seconds()
        self._retry_s = FIRST_RETRY_S
        self._retry: DelayedCall | None = None
        self._probe: DelayedCall | None = None
        self._probes = 0

    @property
    def room(self) -> int:
        """Return how many bytes can leave now."""
        return WINDOW - self._in_flight if self._is_established and not self.is_closed else 0

    def write(self, data: bytes) -> None:
        """Send up to ``room`` bytes."""
        for at in range(0, len(data), SEGMENT):
            self._send(data[at : at + SEGMENT], is_last=False)

    def finish(self) -> None:
        """Send no more: a FIN follows the data in flight."""
        if not self._is_finished and not self.is_closed:
            self._is_finished = True
            self._send(b"", is_last=True)

    def close(self) -> None:
        """Leave the connection to the system: sent data still arrives, then the FIN."""
        self.owner = None
        if self._unread:
            self.reset()
        else:
            self.finish()
            self._stop_probing()

    def reset(self) -> None:
        """Abort it and notify the other side."""
        if not self.is_closed:
            self._route.carry(HEADER, self.peer.on_reset)
            self._end()

    def establish(self) -> None:
        """Establish the connection: by the handshake, or by bytes that imply it."""
        if not self._is_established and not self.is_closed:
            self._is_established = True
            self._heard_s = self._progress_s = self._clock.seconds()
            if self.owner is not None:
                self.owner.on_established()

    def set_reading(self, is_reading: bool) -> None:
        """Hold bytes in the system, or hand them over again."""
        self._is_reading = is_reading
        if is_reading:
            self._clock.callLater(0, self._hand_over)

    def watch(self) -> None:
        """Apply changed options: keepalive starts when it has been enabled."""
        if self.options.keeps_alive and self._probe is None and not self._route.is_perfect:
            self._schedule_probe(self.options.keepalive[0])

    # What arrives from the other end.

    def on_segment(self, offset: int, data: bytes, is_last: bool, sent_s: float) -> None:
        """Take a segment; a duplicate is only acknowledged again."""
        if self.is_closed or (self.owner is None and data):
            self._refuse()
            return
        self._hear()
        if offset > self._expected:
            return
        if offset == self._expected:
            if self._unread_size + len(data) > READ_LIMIT:
                return
            self._expected += len(data) + is_last
            self._is_eof = self._is_eof or is_last
            if data:
                self._unread.append(data)
                self._unread_size += len(data)
        if self._route.is_perfect:
            self.peer.on_acknowledged(self._expected, sent_s)
        else:
            self._route.carry(HEADER, self.peer.on_acknowledged, self._expected, sent_s)
        self._hand_over()

    def on_acknowledged(self, offset: int, sent_s: float) -> None:
        """Forget the arrived data."""
        if self.is_closed:
            return
        self._hear()
        waiting = self._unacknowledged
        before = self._in_flight
        while waiting and waiting[0][0] + len(waiting[0][1]) + waiting[0][2] <= offset:
            self._in_flight -= len(waiting.popleft()[1])
        now_s = self._clock.seconds()
        self.options.round_trip_s = now_s - sent_s
        self._retry_s = max(LEAST_RETRY_S, 2 * (now_s - sent_s))
        self._progress_s = now_s
        if not waiting:
            self._cancel_retry()
            if self.owner is None and self._is_finished:
                self._end()
                return
        if self._in_flight < before and self.owner is not None:
            self.owner.on_room()

    def on_reset(self) -> None:
        """The other side knows nothing of this connection."""
        self._lose(ConnectionLost("the connection was reset"))

    def on_probe(self) -> None:
        """Answer a probe."""
        if self.is_closed:
            self._refuse()
        else:
            self._hear()
            self._route.carry(HEADER, self.peer.on_alive)

    def on_alive(self) -> None:
        """Handle the answer to a probe."""
        if not self.is_closed:
            self._hear()

    def _send(self, data: bytes, *, is_last: bool) -> None:
        now_s = self._clock.seconds()
        if not self._unacknowledged:
            self._progress_s = now_s
        item = (self._sent, data, is_last, now_s)
        self._sent += len(data) + is_last
        self._in_flight += len(data)
        self._unacknowledged.append(item)
        self._route.carry(HEADER + len(data), self.peer.on_segment, *item)
        if self._retry is None and not self._route.is_perfect:
            self._schedule_retry()

    def _hand_over(self) -> None:
        while self._unread and self._is_reading and self.owner is not None:
            data, self._unread, self._unread_size = b"".join(self._unread), [], 0
            self.owner.on_bytes(data)
        if self._is_eof and not self._unread and self._is_reading and self.owner is not None:
            self._is_eof = False
            self.owner.on_eof()

    def _hear(self) -> None:
        self._heard_s = self._clock.seconds()
        self._probes = 0
        self.establish()

    def _refuse(self) -> None:
        """Answer a packet of a connection that no longer exists."""
        if not self.peer.is_closed:
            self._route.carry(HEADER, self.peer.on_reset)

    def _give_up_s(self) -> float:
        return self.options.user_timeout_s or GIVE_UP_S

    def _schedule_retry(self) -> None:
        left_s = self._progress_s + self._give_up_s() - self._clock.seconds()
        wait_s = max(0.0, min(self._retry_s, left_s))
        self._retry = self._clock.callLater(wait_s, self._send_again)

    def _send_again(self) -> None:
        self._retry = None
        if not self._unacknowledged or self.is_closed:
            return
        now_s = self._clock.seconds()
        if now_s - self._progress_s >= self._give_up_s() - 1e-6:
            self._lose(ConnectionLost("nothing was acknowledged in time"))
            return
        oldest_s = self._unacknowledged[0][3]
        if now_s - max(oldest_s, self._progress_s) >= self._retry_s - 1e-6:
            for offset, data, is_last, _ in self._unacknowledged:
                again = (offset, data, is_last, now_s)
                self._route.carry(HEADER + len(data), self.peer.on_segment, *again)
            self._retry_s = min(2 * self._retry_s, LONGEST_RETRY_S)
        self._schedule_retry()

    def _schedule_probe(self, delay_s: float) -> None:
        self._probe = self._clock.callLater(delay_s, self._look_for_peer)

    def _look_for_peer(self) -> None:
        self._probe = None
        if self.is_closed or self.owner is None:
            return
        idle_s, interval_s, most = self.options.keepalive
        silent_s = self._clock.seconds() - self._heard_s
        if silent_s < idle_s - 1e-6:
            self._schedule_probe(idle_s - silent_s)
            return
        limit_s = self.options.user_timeout_s
        is_over = self._probes >= most
        if limit_s:
            is_over = self._probes > 0 and silent_s >= limit_s
        if is_over:
            self._lose(ConnectionLost("no keepalive was answered"))
            return
        if not self._unacknowledged:
            self._probes += 1
            self._route.carry(HEADER, self.peer.on_probe)
        self._schedule_probe(interval_s)

    def _lose(self, error: Exception) -> None:
        if not self.is_closed:
            owner = self.owner
            self._end()
            if owner is not None:
                owner.on_lost(error)

    def _end(self) -> None:
        self.is_closed = True
        self.owner = None
        self._unacknowledged.clear()
        self._unread.clear()
        self._in_flight = 0
        self._cancel_retry()
        self._stop_probing()

    def _cancel_retry(self) -> None:
        if self._retry is not None and self._retry.active():
            self._retry.cancel()
        self._retry = None

    def _stop_probing(self) -> None:
        if self._probe is not None and self._probe.active():
            self._probe.cancel()
        self._probe = None
