"""The operating system's TCP for one end of a connection: order, acknowledgement, timeouts."""

from __future__ import annotations

import socket
import struct
from collections import deque
from typing import Any, Protocol

from twisted.internet.base import DelayedCall
from twisted.internet.error import ConnectionLost

from up.system.clock import cancel
from up_simulator.in_process.network import Route

HEADER = 40
"""Bytes of an IPv4 and a TCP header, which a link carries too."""
SEGMENT = 1448
WINDOW = 10 * SEGMENT
"""Bytes on their way at most (RFC 6928); the rest waits where its program can replace it."""
INITIAL_RETRY_S, MIN_RETRY_S, MAX_RETRY_S = 1.0, 0.2, 120.0
GIVE_UP_S = 924.0
"""Without a user timeout (Linux: 15 retries)."""

_Item = tuple[int, bytes, bool, float]
_RTT_OFFSET = 68
_TCP = socket.IPPROTO_TCP


class SocketOptions:
    """Takes socket options from programs; unknown options have no effect."""

    def __init__(self) -> None:
        self.keeps_alive = False
        self.round_trip_s = 0.0
        self._values: dict[tuple[int, int], int] = {}

    @property
    def user_timeout_s(self) -> float:
        """Return how long bytes may stay unacknowledged; 0: as long as TCP tries."""
        return self._values.get((_TCP, socket.TCP_USER_TIMEOUT), 0) / 1000

    @property
    def keepalive(self) -> tuple[float, float, int]:
        """Return the idle time before a probe, the probe interval, and the number of probes."""
        values = self._values
        return (
            float(values.get((_TCP, socket.TCP_KEEPIDLE), 7200)),
            float(values.get((_TCP, socket.TCP_KEEPINTVL), 75)),
            values.get((_TCP, socket.TCP_KEEPCNT), 9),
        )

    def setsockopt(self, level: int, option: int, value: int | bytes) -> None:
        """Set an option, as of a socket."""
        number = value if isinstance(value, int) else int.from_bytes(value[:4], "little")
        self._values[level, option] = number
        if (level, option) == (socket.SOL_SOCKET, socket.SO_KEEPALIVE):
            self.keeps_alive = bool(number)

    def getsockopt(self, level: int, option: int, size: int = 0) -> int | bytes:
        """Return an option, as of a socket: of TCP_INFO the round trip is known."""
        if (level, option) == (_TCP, socket.TCP_INFO):
            info = bytearray(max(size, _RTT_OFFSET + 4))
            struct.pack_into("=I", info, _RTT_OFFSET, round(self.round_trip_s * 1e6))
            return bytes(info[:size])
        value = self._values.get((level, option), 0)
        return value.to_bytes(size, "little") if size else value


class Owner(Protocol):
    """The user of a connection: a transport."""

    def on_established(self) -> None:
        """Handle the completed handshake."""

    def on_bytes(self, data: bytes) -> None:
        """Handle received bytes, which are in order."""

    def on_eof(self) -> None:
        """Handle the FIN of the other side."""

    def on_lost(self, error: Exception) -> None:
        """Handle a broken connection."""

    def on_room(self) -> None:
        """Handle that more can be written."""


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
        self._last_rx_s = self._progress_s = clock.seconds()
        self._retry_s = INITIAL_RETRY_S
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
            self._last_rx_s = self._progress_s = self._clock.seconds()
            if self.owner is not None:
                self.owner.on_established()

    def watch(self) -> None:
        """Apply changed options: keepalive starts when it has been enabled."""
        if self.options.keeps_alive and self._probe is None and not self._route.is_perfect:
            self._schedule_probe(self.options.keepalive[0])

    # Packets from the other end.

    def on_segment(self, offset: int, data: bytes, is_last: bool, sent_s: float) -> None:
        """Take a segment; a duplicate is only acknowledged again."""
        if self.is_closed or (self.owner is None and data):
            self._refuse()
            return
        self._note_packet()
        if offset > self._expected:
            return
        is_new = offset == self._expected
        if is_new:
            self._expected += len(data) + is_last
        if self._route.is_perfect:
            self.peer.on_acknowledged(self._expected, sent_s)
        else:
            self._route.carry(HEADER, self.peer.on_acknowledged, self._expected, sent_s)
        if is_new and data and self.owner is not None:
            self.owner.on_bytes(data)
        if is_new and is_last and self.owner is not None:
            self.owner.on_eof()

    def on_acknowledged(self, offset: int, sent_s: float) -> None:
        if self.is_closed:
            return
        self._note_packet()
        waiting = self._unacknowledged
        before = self._in_flight
        while waiting and waiting[0][0] + len(waiting[0][1]) + waiting[0][2] <= offset:
            self._in_flight -= len(waiting.popleft()[1])
        now_s = self._clock.seconds()
        self.options.round_trip_s = now_s - sent_s
        self._retry_s = max(MIN_RETRY_S, 2 * (now_s - sent_s))
        self._progress_s = now_s
        if not waiting:
            self._cancel_retry()
            if self.owner is None and self._is_finished:
                self._end()
                return
        if self._in_flight < before and self.owner is not None:
            self.owner.on_room()

    def on_reset(self) -> None:
        """Lose the connection: the other side does not know it."""
        self._lose(ConnectionLost("the connection was reset"))

    def on_probe(self) -> None:
        if self.is_closed:
            self._refuse()
        else:
            self._note_packet()
            self._route.carry(HEADER, self.peer.on_alive)

    def on_alive(self) -> None:
        if not self.is_closed:
            self._note_packet()

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

    def _note_packet(self) -> None:
        self._last_rx_s = self._clock.seconds()
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
            self._retry_s = min(2 * self._retry_s, MAX_RETRY_S)
        self._schedule_retry()

    def _schedule_probe(self, delay_s: float) -> None:
        self._probe = self._clock.callLater(delay_s, self._probe_peer)

    def _probe_peer(self) -> None:
        self._probe = None
        if self.is_closed or self.owner is None:
            return
        idle_s, interval_s, max_probes = self.options.keepalive
        silent_s = self._clock.seconds() - self._last_rx_s
        if silent_s < idle_s - 1e-6:
            self._schedule_probe(idle_s - silent_s)
            return
        limit_s = self.options.user_timeout_s
        is_over = self._probes >= max_probes
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
        self._in_flight = 0
        self._cancel_retry()
        self._stop_probing()

    def _cancel_retry(self) -> None:
        cancel(self._retry)
        self._retry = None

    def _stop_probing(self) -> None:
        cancel(self._probe)
        self._probe = None
