"""The connection to gpsd."""

from typing import Any

from twisted.application.internet import ClientService, backoffPolicy
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.protocol import Factory, Protocol, connectionDone
from twisted.logger import Logger
from twisted.python.failure import Failure

from gps_cog.receiver import Receiver

LOOPBACK = "127.0.0.1"
CONNECT_S = 2.0
FIRST_RETRY_S, LAST_RETRY_S = 0.5, 2.0


class GpsdSource:
    """Keeps a connection to gpsd on this machine, and requests its reports by ``watch``."""

    def __init__(
        self, reactor: Any, port: int, receiver: Receiver, watch: bytes, log: Logger
    ) -> None:
        self.receiver = receiver
        self.watch = watch
        self.log = log
        factory: Any = Factory()
        factory.noisy = False
        factory.protocol = lambda: _GpsdLink(self)
        endpoint: Any = TCP4ClientEndpoint(reactor, LOOPBACK, port, timeout=CONNECT_S)
        retry: Any = backoffPolicy(FIRST_RETRY_S, LAST_RETRY_S)
        self._service = ClientService(endpoint, factory, retryPolicy=retry, clock=reactor)

    def start(self) -> None:
        self._service.startService()
        self._service.whenConnected(failAfterFailures=1).addErrback(self._on_failed)

    def stop(self) -> Any:
        """Close the connection; the result fires when it is closed."""
        return self._service.stopService()

    def _on_failed(self, failure: Failure) -> None:
        text = "no connection to gpsd: {reason}; trying again"
        self.log.warn(text, reason=failure.getErrorMessage(), code="gpsd_unavailable")


class _GpsdLink(Protocol):
    """One connection."""

    def __init__(self, source: GpsdSource) -> None:
        self._source = source

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        transport: Any = self.transport
        self._source.receiver.decoder.reset()
        transport.write(self._source.watch)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        self._source.receiver.on_bytes(data)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        self._source.log.warn("lost gpsd; trying again", code="gpsd_lost")
