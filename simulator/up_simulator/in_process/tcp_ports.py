"""Listening and connecting in memory, as listenTCP and connectTCP do."""

from __future__ import annotations

from typing import Any

from twisted.internet.address import IPv4Address
from twisted.internet.base import DelayedCall
from twisted.internet.defer import Deferred, succeed
from twisted.internet.error import ConnectionRefusedError as Refused
from twisted.internet.error import TimeoutError, UserError
from twisted.internet.interfaces import IConnector, IListeningPort
from twisted.python.failure import Failure
from zope.interface import implementer

from up.system.clock import cancel
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.tcp_end import HEADER, TcpEnd
from up_simulator.in_process.tcp_transport import TcpTransport

INITIAL_SYN_RETRY_S = 1.0


@implementer(IListeningPort)
class TcpPort:
    """A port that accepts connections until it is stopped."""

    def __init__(self, host: Any, port: int, factory: Any, interface: str) -> None:
        self.factory = factory
        self.interface = interface
        self.host = host
        self._number = port
        self._is_open = False

    def startListening(self) -> None:  # noqa: N802 - Twisted's name
        """Open it; raises CannotListenError."""
        network = self.host.network
        self._number = network.bind(network.tcp, self._number, self, self.interface)
        self._is_open = True
        self.host.opened[self] = None
        self.factory.doStart()

    def stopListening(self) -> Deferred[None]:  # noqa: N802 - Twisted's name
        """Close it; connections stay."""
        if self._is_open:
            self.cut_off()
            self.factory.doStop()
        return succeed(None)

    loseConnection = stopListening  # noqa: N815 - Twisted's name

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return IPv4Address("TCP", self.interface or "0.0.0.0", self._number)

    def cut_off(self) -> None:
        """Close it without a notification."""
        self._is_open = False
        self.host.opened.pop(self, None)
        self.host.network.tcp.pop(self._number, None)

    def accept(self, end: TcpEnd, from_port: int) -> None:
        """Take a new connection; it is refused if the factory builds no protocol."""
        transport = TcpTransport(self.host, end, self._number, from_port)
        self.host.do(self._build, transport, IPv4Address("TCP", ADDRESS, from_port))

    def _build(self, transport: TcpTransport, address: IPv4Address) -> None:
        protocol = self.host.reactor.guarded(self.factory.buildProtocol, address)
        if protocol is None:
            transport.refuse()
        else:
            transport.protocol = protocol


class _Attempt:
    """The handshake: lost packets are sent again, a closed port refuses it."""

    def __init__(self, host: Any, connector: Connector, port: int, own_port: int) -> None:
        self._network = host.network
        self._host = host
        self._connector = connector
        self._port = port
        self._own_port = own_port
        self._up, self._down = self._network.routes(port)
        self._wait_s = INITIAL_SYN_RETRY_S
        self._end: TcpEnd | None = None
        self._retry: DelayedCall | None = None
        self.is_over = False

    def send_syn(self) -> None:
        """Send a SYN, again and again until it is answered."""
        if not self.is_over:
            self._up.carry(HEADER, self._on_syn)
            self._retry = self._host.callLater(self._wait_s, self.send_syn)
            self._wait_s *= 2

    def end(self) -> None:
        self.is_over = True
        cancel(self._retry)

    def _on_syn(self) -> None:
        port = self._network.tcp.get(self._port)
        if self._end is None and port is None:
            self._down.carry(HEADER, self._on_refused)
            return
        if self._end is None:
            self._end = TcpEnd(self._network.clock, self._up)
            peer = TcpEnd(self._network.clock, self._down)
            self._end.peer, peer.peer = peer, self._end
            # Before any data of the other side, which may cut the connection off immediately.
            self._down.carry(HEADER, self._on_syn_ack)
            port.accept(peer, self._own_port)
        else:
            self._down.carry(HEADER, self._on_syn_ack)

    def _on_refused(self) -> None:
        if not self.is_over:
            self._host.do(self._connector.fail, Refused())

    def _on_syn_ack(self) -> None:
        end = self._end
        if end is None or self.is_over:
            return
        self.end()
        self._host.do(self._connector.succeed, end)
        self._up.carry(HEADER, end.peer.establish)


@implementer(IConnector)
class Connector:
    """One attempt to connect, and the resulting connection."""

    def __init__(self, host: Any, address: str, port: int, factory: Any, timeout_s: float) -> None:
        self.factory = factory
        self.timeout = timeout_s
        self.transport: TcpTransport | None = None
        self.state = "disconnected"
        self._host = host
        self._address = address
        self._port = port
        self._own_port = 0
        self._timers: list[DelayedCall] = []
        self._attempt: _Attempt | None = None

    def connect(self) -> None:
        """Begin; raises where an attempt is under way."""
        if self.state != "disconnected":
            raise RuntimeError("cannot connect in this state")
        self.state = "connecting"
        self.factory.doStart()
        self.factory.startedConnecting(self)
        self._host.opened[self] = None
        self._own_port = self._host.network.free_port()
        self._attempt = _Attempt(self._host, self, self._port, self._own_port)
        self._attempt.send_syn()
        if self.timeout:
            self._timers.append(self._host.callLater(self.timeout, self._on_timeout))

    def stopConnecting(self) -> None:  # noqa: N802 - Twisted's name
        if self.state != "connecting":
            raise RuntimeError("no attempt is under way")
        self.fail(UserError())

    def disconnect(self) -> None:
        """Give up the attempt, or close the connection."""
        if self.state == "connecting":
            self.stopConnecting()
        elif self.state == "connected" and self.transport is not None:
            self.transport.loseConnection()

    def getDestination(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return IPv4Address("TCP", self._address, self._port)

    def cut_off(self) -> None:
        """End without a notification."""
        self._stop()

    def succeed(self, end: TcpEnd) -> None:
        self._stop()
        self.state = "connected"
        self.transport = TcpTransport(self._host, end, self._own_port, self._port)
        address = self.getDestination()
        protocol = self._host.reactor.guarded(self.factory.buildProtocol, address)
        if protocol is None:
            self.transport.refuse()
            self.state = "disconnected"
            return
        self.transport.protocol = protocol
        self.transport.on_closed = self.lost
        end.establish()

    def fail(self, error: Exception) -> None:
        if self.state == "connecting":
            self._stop()
            self.state = "disconnected"
            self.factory.clientConnectionFailed(self, Failure(error))
            if self.state == "disconnected":
                self.factory.doStop()

    def lost(self, reason: Failure) -> None:
        self.state = "disconnected"
        self.factory.clientConnectionLost(self, reason)
        if self.state == "disconnected":
            self.factory.doStop()

    def _on_timeout(self) -> None:
        self.fail(TimeoutError())

    def _stop(self) -> None:
        self._host.opened.pop(self, None)
        if self._attempt is not None:
            self._attempt.end()
        for timer in self._timers:
            cancel(timer)
        self._timers.clear()
