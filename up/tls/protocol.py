"""A TLS connection on Twisted's TCP, for the clients and for servers of few connections."""

from __future__ import annotations

import ssl
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.interfaces import (
    IProtocolFactory,
    IPushProducer,
    ISSLTransport,
    IStreamClientEndpoint,
)
from twisted.internet.protocol import Factory, Protocol, ServerFactory, connectionDone
from twisted.logger import Logger
from twisted.python.failure import Failure
from zope.interface import implementer

from up.log.limits import Limited
from up.system.clock import Timer, cancel
from up.tls.errors import TIMEOUT, TLSError, fault_of
from up.tls.files import TLSFiles, peer_name

HANDSHAKE_LIMIT_S = 5.0
MAX_HANDSHAKES = 64
"""Of a server; at a further connection the oldest handshake is ended."""
LOG_INTERVAL_S = 10.0
"""Minimum time between two log lines of one code."""
_READ_BYTES = 65536

Build = Callable[[Any], Protocol | None]


@implementer(ISSLTransport, IPushProducer)
class TLSProtocol(Protocol):
    """The protocol of a TCP transport, and the transport of the protocol inside.

    That is built and connected after the handshake, so it never sees an unverified peer; ``done``
    then fires with it, or with a TLSError. A later fault is the reason of its connectionLost.
    Addresses, TCP options and producers are the TCP transport's.
    """

    transport: Any

    def __init__(
        self,
        reactor: Any,
        context: ssl.SSLContext,
        build: Build,
        on_handshake: Callable[[TLSProtocol], object] = lambda _: None,
        server_name: str | None = None,
    ) -> None:
        self.done: Deferred[Protocol] = Deferred(lambda _: self.abortConnection())
        self.peer_name = ""
        self.error: TLSError | None = None
        self._reactor = reactor
        self._build = build
        self._on_handshake = on_handshake
        self._incoming, self._outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
        self._tls = context.wrap_bio(
            self._incoming, self._outgoing, server_name is None, server_name
        )
        self._inner: Protocol | None = None
        self._is_closed = False
        self._limit: Timer | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self.transport, name)

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self._limit = self._reactor.callLater(HANDSHAKE_LIMIT_S, self._on_timeout)
        self._shake_hands()

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        if self._is_closed:
            return
        self._incoming.write(data)
        if self._inner is None:
            self._shake_hands()
        if self._inner is not None:
            self._read(self._inner)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802 - Twisted's name
        self._is_closed = True
        if self._inner is not None:
            self._inner.connectionLost(reason if self.error is None else Failure(self.error))
            return
        cancel(self._limit)
        self._on_handshake(self)
        if self.error is None:
            self.error = fault_of(ConnectionError())
        if not self.done.called:
            self.done.errback(Failure(self.error))

    def write(self, data: bytes) -> None:
        """Encrypt and send; the transport below has the only buffer."""
        if not self._is_closed and data:
            self._tls.write(data)
            self._flush()

    def writeSequence(self, data: Iterable[bytes]) -> None:  # noqa: N802 - Twisted's name
        self.write(b"".join(data))

    def loseConnection(self) -> None:  # noqa: N802 - Twisted's name
        self._notify_close()
        self.transport.loseConnection()

    def loseWriteConnection(self) -> None:  # noqa: N802 - Twisted's name
        self._notify_close()
        self.transport.loseWriteConnection()

    def abortConnection(self) -> None:  # noqa: N802 - Twisted's name
        self._is_closed = True
        self.transport.abortConnection()

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        self.loseConnection()

    def getPeerCertificate(self) -> object:  # noqa: N802 - Twisted's name
        return self._tls.getpeercert()

    def _shake_hands(self) -> None:
        try:
            self._tls.do_handshake()
        except ssl.SSLWantReadError:
            self._flush()
            return
        except OSError as error:
            self._flush()
            self._fail(fault_of(error))
            return
        self._flush()
        cancel(self._limit)
        self.peer_name = peer_name(self._tls)
        self._on_handshake(self)
        inner = self._build(self.transport.getPeer())
        if inner is None:
            self.abortConnection()
            return
        self._inner = inner
        inner.makeConnection(self)
        self.done.callback(inner)

    def _read(self, inner: Protocol) -> None:
        while not self._is_closed:
            try:
                data = self._tls.read(_READ_BYTES)
            except ssl.SSLWantReadError:
                break
            except ssl.SSLZeroReturnError:
                data = b""
            except OSError as error:
                self._fail(fault_of(error))
                return
            if not data:
                self.transport.loseConnection()
                return
            inner.dataReceived(data)
        self._flush()

    def _flush(self) -> None:
        if self._outgoing.pending:
            self.transport.write(self._outgoing.read())

    def _notify_close(self) -> None:
        if self._is_closed:
            return
        self._is_closed = True
        with suppress(OSError):
            # It writes the notice; the peer's is not awaited.
            self._tls.unwrap()
        self._flush()

    def _on_timeout(self) -> None:
        text = f"no TLS handshake within {HANDSHAKE_LIMIT_S:g} s"
        self._fail(TLSError(text, TIMEOUT), is_heard=False)

    def _fail(self, error: TLSError, *, is_heard: bool = True) -> None:
        """End the connection; the alert that tells the peer why leaves first."""
        self.error = self.error or error
        self._is_closed = True
        if is_heard:
            self.transport.loseConnection()
        else:
            self.transport.abortConnection()


@implementer(IStreamClientEndpoint)
class TLSClientEndpoint:
    """Connects by another endpoint, then by TLS to the server of the name ``host``.

    The Deferred of `connect` fails with TLSError.
    """

    def __init__(self, reactor: Any, endpoint: Any, files: TLSFiles, host: str) -> None:
        self._reactor = reactor
        self._endpoint = endpoint
        self._files = files
        self._host = host.partition("%")[0]

    def connect(self, protocolFactory: IProtocolFactory) -> Deferred[Any]:  # noqa: N803
        factory: Any = protocolFactory
        try:
            context = self._files.client()
        except TLSError as fault:
            failed: Deferred[Any] = Deferred()
            failed.errback(Failure(fault))
            return failed
        made: Any = Factory.forProtocol(
            lambda: TLSProtocol(
                self._reactor, context, factory.buildProtocol, server_name=self._host
            )
        )
        made.noisy = False
        connecting: Deferred[Any] = self._endpoint.connect(made)
        return connecting.addCallback(lambda protocol: protocol.done)


class TLSServerFactory(ServerFactory):
    """Wraps a server's factory; handshakes are bounded in number and time.

    With ``clients`` every peer needs a certificate of the CA.
    """

    noisy = False
    log = Logger()

    def __init__(self, reactor: Any, files: TLSFiles, wrapped: Any, *, clients: bool) -> None:
        self._reactor = reactor
        self._files = files
        self._wrapped = wrapped
        self._clients = clients
        self._pending: dict[TLSProtocol, None] = {}
        self._limited = Limited(reactor, LOG_INTERVAL_S)
        files.server(clients=clients)

    def doStart(self) -> None:  # noqa: N802 - Twisted's name
        super().doStart()  # type: ignore[no-untyped-call]
        self._wrapped.doStart()

    def doStop(self) -> None:  # noqa: N802 - Twisted's name
        self._limited.stop()
        self._wrapped.doStop()
        super().doStop()  # type: ignore[no-untyped-call]

    def buildProtocol(self, addr: Any) -> TLSProtocol:  # noqa: N802 - Twisted's name
        if len(self._pending) >= MAX_HANDSHAKES:
            oldest = next(iter(self._pending))
            del self._pending[oldest]
            oldest.abortConnection()
        context = self._files.server(clients=self._clients)
        made = TLSProtocol(self._reactor, context, self._wrapped.buildProtocol, self._on_handshake)
        made.done.addErrback(self._on_failed, addr.host)
        self._pending[made] = None
        return made

    def _on_handshake(self, made: TLSProtocol) -> None:
        self._pending.pop(made, None)

    def _on_failed(self, failure: Failure, host: str) -> None:
        error: Any = failure.value
        if not self.numPorts:
            return  # closed
        self._limited.log(
            self.log.warn,
            "{host}: {error}",
            key=error.code,
            host=host,
            error=str(error),
            code=error.code,
        )
