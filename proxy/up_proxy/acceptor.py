"""The port of one side: accepts, limits, checks addresses, closes idle connections."""

import errno
import select
import socket
from collections import Counter
from contextlib import suppress
from sys import intern

from up.log import Limited, UpLogger
from up.protocols.proxy_lines import ADDRESS, FULL, HelloError, Refused, Side
from up.system.addresses import is_private, neighbourhood, plain
from up.system.clock import Clock, Timer, cancel
from up.system.token_bucket import TokenBucket
from up.tls.files import TLSFiles
from up_proxy.admission_queue import AdmissionQueue
from up_proxy.config import ProxyConfig
from up_proxy.connection import Connection
from up_proxy.handshake import Handshake
from up_proxy.poller import Poller
from up_proxy.registry import LOG_INTERVAL_S
from up_proxy.tls_handshakes import TLSHandshakes
from up_proxy.tls_socket import TLSSocket

_ACCEPT_BATCH = 64
_TURN_S = 0.05
"""Period at which waiting connections are admitted."""
_WAIT_S = 2.0
"""As many may wait as the rate admits in this time; clients give up after 5 s."""
_OUT_OF_DESCRIPTORS = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
_RETRY_S = 1.0
_log = UpLogger.get_logger("proxy")


class Acceptor:
    """The listening socket of one side and all its connections."""

    def __init__(
        self,
        listener: socket.socket,
        handshake: Handshake,
        poller: Poller,
        clock: Clock,
        side: Side,
        config: ProxyConfig,
        tls: TLSFiles | None = None,
    ) -> None:
        self._listener = listener
        self._handshake = handshake
        self._poller = poller
        self._clock = clock
        self.side = side
        self._limits = config.limits
        self._accepts_public = config.i_accept_plain or tls is not None
        # The queue of an aircraft is bounded by pausing the ground, never by dropping lines.
        self._queue_bytes = config.limits.queue_bytes if side is Side.GROUND else 0
        self._sources: Counter[str] = Counter()
        rate_hz = config.limits.connections_hz
        self._rate = TokenBucket(clock, rate_hz, max(1.0, rate_hz * _TURN_S))
        self._waiting = AdmissionQueue[tuple[socket.socket, str]](round(rate_hz * _WAIT_S))
        self._turn: Timer | None = None
        self._retry: Timer | None = None
        self._on_closed = self._discard
        self._public_logged = False
        self.connections: set[Connection] = set()
        self.accepted = 0
        self.over_limit = 0
        self.idle_closed = 0
        self.refused = handshake.refused
        self.tls: TLSHandshakes | None = None
        if tls is not None:
            self._log = Limited(clock, LOG_INTERVAL_S)
            self.tls = TLSHandshakes(
                tls, poller, self._log, config.tls.handshakes, self._connect, self._release
            )
            self._context = tls.server()

    @property
    def port(self) -> int:
        return int(self._listener.getsockname()[1])

    def open(self) -> None:
        self._poller.watch(self._listener.fileno(), self)
        text = "{side} side listens on port {port}"
        _log.info(
            text if self.tls is None else f"{text} (TLS)",
            code="port_open",
            side=self.side.value,
            port=self.port,
            tls=self.tls is not None,
        )

    def close(self) -> None:
        cancel(self._retry)
        self._retry = None
        self.end()
        if self.tls is not None:
            self.tls.close()
            self._log.stop()
        cancel(self._turn)
        while self._waiting:
            self._waiting.pop()[0].close()
        for connection in self.connections:
            connection.fail("the proxy is stopping")

    def on_ready(self, events: int) -> None:
        for _ in range(_ACCEPT_BATCH):
            try:
                peer, address = self._listener.accept()
            except BlockingIOError:
                return
            except OSError as error:
                if error.errno in _OUT_OF_DESCRIPTORS:
                    self._pause()
                    return
                continue  # the peer closed before it was accepted
            # Many share an address, those of a mobile network too.
            self._accept(peer, intern(plain(address[0])))

    def fail(self, reason: str) -> None:
        """Pause: one failure must not close the listening socket."""
        self._pause()

    def end(self) -> None:
        self._poller.discard(self._listener.fileno())
        self._listener.close()

    def is_open(self) -> bool:
        """Return whether the port is listened on or will be after a pause."""
        return self._listener.fileno() >= 0

    def sweep(self, now_s: float) -> None:
        """End idle connections, and call the handshake's timer."""
        for connection in self.connections:
            if connection.is_idle(now_s):
                self.idle_closed += 1
                connection.fail("idle")
        self._handshake.sweep(now_s)
        if self.tls is not None:
            self.tls.sweep(now_s)
            self._check_revoked(self.tls.files)

    def _accept(self, peer: socket.socket, host: str) -> None:
        error = self._check(host)
        if error is not None:
            self._refuse(peer, error)
            return
        peer.setblocking(False)
        source = neighbourhood(host)
        self._sources[source] += 1
        if not self._waiting and self._rate.take():
            self._admit(peer, host)
            return
        lost = self._waiting.put(source, (peer, host))
        if lost is not None:
            self.over_limit += 1
            self._release(lost[1])
            self._refuse(lost[0], HelloError(FULL, "too many new connections"))
        if self._turn is None:
            self._turn = self._clock.callLater(_TURN_S, self._admit_waiting)

    def _refuse(self, peer: socket.socket, error: HelloError) -> None:
        if self.tls is None:
            with suppress(OSError):
                peer.send(Refused(error.code, error.reason).encode())
        peer.close()

    def _admit(self, peer: socket.socket, host: str) -> None:
        if self.tls is None:
            self._connect(peer, host)
        else:
            self.tls.begin(peer, host)

    def _admit_waiting(self) -> None:
        while self._waiting and self._rate.take():
            self._admit_next()
        again = bool(self._waiting)
        self._turn = self._clock.callLater(_TURN_S, self._admit_waiting) if again else None

    def _admit_next(self) -> None:
        """Admit the next one that is still there, and drop those that are not."""
        while self._waiting:
            peer, host = self._waiting.pop()
            if _is_there(peer):
                self._admit(peer, host)
                return
            self._release(host)
            peer.close()

    def _connect(self, peer: socket.socket | TLSSocket, host: str) -> None:
        self.accepted += 1
        connection = Connection(
            peer, self._poller, host, self._handshake, self._on_closed, self._queue_bytes
        )
        self.connections.add(connection)
        self._handshake.begin(connection)

    def _check_revoked(self, files: TLSFiles) -> None:
        """End the connections whose certificates a new list names."""
        context = files.server()
        if context is self._context:
            return
        self._context = context
        revoked = files.revoked_among(each.serial for each in self.connections)
        for connection in self.connections:
            if connection.serial in revoked:
                connection.fail("its certificate is revoked")

    def _check(self, host: str) -> HelloError | None:
        if not self._accepts_public and not is_private(host):
            self.refused[ADDRESS] += 1
            if not self._public_logged:
                self._public_logged = True
                _log.warn(
                    "refused {host} on the {side} side: plain traffic over a public network needs "
                    "'i_accept_plain: true' in proxy.yml (logged once)",
                    code="public_peer_refused",
                    host=host,
                    side=self.side.value,
                )
            return HelloError(ADDRESS, "plain connections from public addresses are not accepted")
        if len(self.connections) + len(self._waiting) >= self._limits.connections:
            self.over_limit += 1
            return HelloError(FULL, "too many connections on this side")
        if self._sources[neighbourhood(host)] >= self._limits.per_address:
            self.over_limit += 1
            return HelloError(FULL, "too many connections from your address")
        return None

    def _discard(self, connection: Connection) -> None:
        self.connections.discard(connection)
        self._release(connection.host)

    def _release(self, host: str) -> None:
        source = neighbourhood(host)
        self._sources[source] -= 1
        if self._sources[source] <= 0:
            del self._sources[source]

    def _pause(self) -> None:
        if self._retry is None and self.is_open():
            _log.error(
                "{side} side accepts nothing for {pause_s:g} s: too many open files",
                code="out_of_descriptors",
                side=self.side.value,
                pause_s=_RETRY_S,
            )
            self._poller.discard(self._listener.fileno())
            self._retry = self._clock.callLater(_RETRY_S, self._resume)

    def _resume(self) -> None:
        self._retry = None
        self._poller.watch(self._listener.fileno(), self)


def _is_there(peer: socket.socket) -> bool:
    """Return whether the peer has not closed; an unread hello does not hide that."""
    look = select.poll()
    look.register(peer, select.POLLRDHUP)
    return not look.poll(0)
