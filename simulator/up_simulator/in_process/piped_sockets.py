"""The sockets of a program behind a pipe, opened on a simulated machine."""

from __future__ import annotations

from typing import Any

from twisted.internet.interfaces import IPullProducer
from twisted.internet.protocol import ClientFactory, DatagramProtocol, Protocol
from zope.interface import implementer

BYTES = "latin-1"


class PipedSockets:
    """Carries out the network requests of a stepped virtual phone, and collects the events.

    Both are lists of words, as on the virtual phone's page. ``machine`` is the reactor.
    """

    def __init__(self, machine: Any) -> None:
        self._machine = machine
        self._connections: dict[int, _Connection] = {}
        self._ports: dict[int, Any] = {}
        self._brought: list[list[Any]] = []
        self.is_urgent = False

    def take(self) -> list[list[Any]]:
        """Return the events since the last call."""
        for connection in list(self._connections.values()):
            connection.tell_room()
        taken, self._brought = self._brought, []
        self.is_urgent = False
        return taken

    def do(self, words: list[Any]) -> None:
        """Do one thing."""
        kind, number, *rest = words
        match kind:
            case "connect":
                host, port, timeout_ms = rest
                connection = self._connections[number] = _Connection(self, number)
                connection.connector = self._machine.connectTCP(
                    host, port, connection.factory, timeout=timeout_ms / 1000
                )
            case "write" if number in self._connections:
                self._connections[number].write(rest[0].encode(BYTES))
            case "full" if number in self._connections:
                self._connections[number].is_full = True
            case "close" if number in self._connections:
                self._connections.pop(number).end()
            case "open":
                self._ports[number] = self._machine.listenUDP(0, _Datagrams(self, number))
            case "send" if number in self._ports:
                data, host, port = rest
                self._ports[number].write(data.encode(BYTES), (host, port))
            case "shut" if number in self._ports:
                self._ports.pop(number).stopListening()

    def bring(self, *words: Any) -> None:
        """Keep something for the next line."""
        self._brought.append(list(words))
        self.is_urgent = True

    def forget(self, number: int) -> None:
        """Forget a connection that has ended."""
        self._connections.pop(number, None)

    def close(self) -> None:
        """Close everything."""
        connections, self._connections = self._connections, {}
        ports, self._ports = self._ports, {}
        for connection in connections.values():
            connection.end()
        for port in ports.values():
            port.stopListening()


@implementer(IPullProducer)
class _Connection(Protocol):
    """One connection; as a producer it is notified when all written data has left."""

    def __init__(self, sockets: PipedSockets, number: int) -> None:
        self._sockets = sockets
        self._number = number
        self._waiting = 0
        self._left = 0
        self._has_ended = False
        self.is_full = False
        self.connector: Any = None
        self.factory = _Once(self)

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        """Report the connection."""
        transport: Any = self.transport
        transport.setTcpNoDelay(True)
        transport.registerProducer(self, False)
        self._sockets.bring("connected", self._number)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        """Report the bytes."""
        self._sockets.bring("bytes", self._number, data.decode(BYTES))

    def connectionLost(self, reason: Any = None) -> None:  # noqa: N802 - Twisted's name
        """Report the end, unless it was requested."""
        self.fail("the connection was lost")

    def fail(self, reason: str) -> None:
        """Report its end, once."""
        if not self._has_ended:
            self._has_ended = True
            self._sockets.bring("closed", self._number, reason)
            self._sockets.forget(self._number)

    def write(self, data: bytes) -> None:
        """Send bytes."""
        transport: Any = self.transport
        if transport is not None:
            self._waiting += len(data)
            transport.write(data)

    def tell_room(self) -> None:
        """Report the bytes that have left since the last call."""
        if self._left:
            left, self._left = self._left, 0
            self.is_full = False
            self._sockets.bring("room", self._number, left)

    def end(self) -> None:
        """Abort the connection without a notification."""
        self._has_ended = True
        if self.transport is not None:
            transport: Any = self.transport
            transport.abortConnection()
        elif self.connector is not None:
            self.connector.disconnect()

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Handle that all data has left."""
        self._left += self._waiting
        self._waiting = 0
        if self.is_full and self._left:
            self._sockets.is_urgent = True

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: the end of the connection is reported separately."""


class _Once(ClientFactory):
    """Makes the one protocol, or reports why the connection failed."""

    noisy = False

    def __init__(self, connection: _Connection) -> None:
        self._connection = connection

    def buildProtocol(self, addr: Any) -> Protocol:  # noqa: N802 - Twisted's name
        """Return it."""
        return self._connection

    def clientConnectionFailed(self, connector: Any, reason: Any) -> None:  # noqa: N802
        """Report it."""
        where = connector.getDestination()
        self._connection.fail(
            f"no connection to {where.host}:{where.port} ({reason.type.__name__})"
        )


class _Datagrams(DatagramProtocol):
    """One socket for datagrams."""

    def __init__(self, sockets: PipedSockets, number: int) -> None:
        self._sockets = sockets
        self._number = number

    def datagramReceived(self, datagram: bytes, addr: Any) -> None:  # noqa: N802
        """Report a datagram."""
        self._sockets.bring("datagram", self._number, datagram.decode(BYTES), addr[0], addr[1])
