"""The TLS handshakes of one port: bounded in number, in time, and in their share of the CPU."""

import socket
import ssl
from collections.abc import Callable

from up.log import Limited, UpLogger
from up.protocols.proxy_lines import MALFORMED, Refused
from up.tls.errors import FAILED, PEER_PLAIN, TIMEOUT, TLSError, fault_of
from up.tls.files import TLSFiles, peer_name, peer_serial
from up_proxy.poller import READ, WRITE, Poller
from up_proxy.tls_socket import TLSSocket

HANDSHAKE_LIMIT_S = 5.0
_DISCARD_BYTES = 65536
_TLS_HANDSHAKE = b"\x16"
"""The first byte of a TLS connection."""
_log = UpLogger.get_logger("proxy")


class TLSHandshakes:
    """Hands on a connection whose peer has a valid certificate of the CA.

    ``on_done`` gets the socket and the peer's address, ``on_failed`` the address. At the limit the
    oldest handshake is ended. ``failed`` counts by code.
    """

    def __init__(
        self,
        files: TLSFiles,
        poller: Poller,
        log: Limited,
        limit: int,
        on_done: Callable[[TLSSocket, str], None],
        on_failed: Callable[[str], None],
    ) -> None:
        self.failed: dict[str, int] = {}
        self.files = files
        self._poller = poller
        self._log = log
        self._limit = limit
        self._on_done = on_done
        self._on_failed = on_failed
        self._pending: dict[_Pending, None] = {}

    def __len__(self) -> int:
        return len(self._pending)

    def begin(self, peer: socket.socket, host: str) -> None:
        if len(self._pending) >= self._limit:
            oldest = next(iter(self._pending))
            self.fail(oldest, TLSError("too many unfinished handshakes", "tls_displaced"))
            self.end(oldest)
        self._pending[_Pending(self, self._poller, peer, host)] = None

    def sweep(self, now_s: float) -> None:
        for each in list(self._pending):
            if now_s - each.since_s < HANDSHAKE_LIMIT_S:
                return
            text = f"no TLS handshake within {HANDSHAKE_LIMIT_S:g} s"
            self.fail(each, TLSError(text, TIMEOUT))
            self.end(each)

    def close(self) -> None:
        for each in list(self._pending):
            self.end(each)

    def finish(self, pending: "_Pending", connected: ssl.SSLSocket) -> None:
        del self._pending[pending]
        done = TLSSocket(connected, peer_name(connected), peer_serial(connected))
        self._on_done(done, pending.host)

    def fail(self, pending: "_Pending", fault: TLSError) -> None:
        """Count a failure; it is logged at a limited rate for each code."""
        if pending.has_failed:
            return
        pending.has_failed = True
        self.failed[fault.code] = self.failed.get(fault.code, 0) + 1
        self._log.log(
            _log.warn,
            "{host}: {fault}",
            key=fault.code,
            code=fault.code,
            host=pending.host,
            fault=str(fault),
        )

    def end(self, pending: "_Pending") -> None:
        """Close a connection that failed."""
        del self._pending[pending]
        pending.close()
        self._on_failed(pending.host)


class _Pending:
    """One handshake. Each of its steps waits for its turn behind relayed lines."""

    __slots__ = ("_owner", "_poller", "_socket", "_tls", "has_failed", "host", "since_s")

    def __init__(
        self, owner: TLSHandshakes, poller: Poller, peer: socket.socket, host: str
    ) -> None:
        self._owner = owner
        self._poller = poller
        self._socket = peer
        self._tls: ssl.SSLSocket | None = None
        self.has_failed = False
        self.host = host
        self.since_s = poller.now_s
        poller.watch(peer.fileno(), self)

    def on_ready(self, events: int) -> None:
        # Not watched until its step: a second event must not queue it twice.
        self._poller.discard(self._socket.fileno())
        self._poller.do_later(self._step)

    def fail(self, reason: str) -> None:
        self._poller.end_later(self)

    def end(self) -> None:
        self._owner.fail(self, TLSError("internal error", FAILED))
        self._owner.end(self)

    def close(self) -> None:
        self._poller.discard(self._socket.fileno())
        self._socket.close()

    def _step(self) -> None:
        if self._socket.fileno() < 0:
            return
        try:
            if self.has_failed:
                self._discard()
                return
            if self._tls is None:
                self._begin()
            if self._tls is not None:
                self._tls.do_handshake()
                self._owner.finish(self, self._tls)
        except (ssl.SSLWantReadError, BlockingIOError):
            self._poller.watch(self._socket.fileno(), self, READ)
        except ssl.SSLWantWriteError:
            self._poller.watch(self._socket.fileno(), self, WRITE)
        except OSError as error:
            self._refuse(fault_of(error))

    def _refuse(self, fault: TLSError) -> None:
        """Fail, and read on for a while: a reset could overtake the alert that gives the reason."""
        self._owner.fail(self, fault)
        try:
            socket.socket.shutdown(self._socket, socket.SHUT_WR)
            self._discard()
        except OSError:
            self._owner.end(self)

    def _discard(self) -> None:
        try:
            if not socket.socket.recv(self._socket, _DISCARD_BYTES):
                self._owner.end(self)
                return
        except BlockingIOError:
            pass
        self._poller.watch(self._socket.fileno(), self, READ)

    def _begin(self) -> None:
        """Take memory for TLS when the first byte shows that the peer speaks it."""
        try:
            first = self._socket.recv(1, socket.MSG_PEEK)
        except ConnectionError:
            first = b""
        if not first:
            # A probe of the path or the port: no fault.
            self._owner.end(self)
            return
        if first != _TLS_HANDSHAKE:
            self._socket.send(Refused(MALFORMED, "this port speaks TLS alone").encode())
            self._refuse(TLSError("it does not speak TLS on this port", PEER_PLAIN))
            return
        context = self._owner.files.server()
        self._tls = self._socket = context.wrap_socket(
            self._socket, server_side=True, do_handshake_on_connect=False
        )
