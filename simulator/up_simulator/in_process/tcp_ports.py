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

from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.tcp_end import HEADER, TcpEnd
from up_simulator.in_process.tcp_transport import TcpTransport

FIRST_SYN_S = 1.0


@implementer(IListeningPort)
class TcpPort:
    """A port that accepts connections until it is stopped."""

    def __init__(self, machine: Any, port: int, factory: Any, interface: str) -> None:
        self.factory = factory
        self.interface = interface
        self.machine = machine
        self._number = port
        self._is_open = False

    def startListening(self) -> None:  # noqa: N802 - Twisted's name
        """Open it; raises CannotListenError."""
        network = self.machine.network
        self._number = network.bind(network.tcp, self._number, self, self.interface)
        self._is_open = True
        self.machine.opened[self] = None
        self.factory.doStart()

    def stopListening(self) -> Deferred[None]:  # noqa: N802 - Twisted's name
        """Close it; connections stay."""
        if self._is_open:
            self.cut_off()
            self.factory.doStop()
        return succeed(None)

    loseConnection = stopListening  # noqa: N815 - Twisted's name

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        """Return where it listens."""
        return IPv4Address("TCP", self.interface or "0.0.0.0", self._number)

    def cut_off(self) -> None:
        """Close it without a notification."""
        self._is_open = False
        self.machine.opened.pop(self, None)
        self.machine.network.tcp.pop(self._number, None)

    def accept(self, end: TcpEnd, from_port: int) -> None:
        """Take a new connection; it is refused if the factory builds no protocol."""
        transport = TcpTransport(self.machine, end, self._number, from_port)
        self.machine.do(self._build, transport, IPv4Address("TCP", ADDRESS, from_port))

    def _build(self, transport: TcpTransport, address: IPv4Address) -> None:
        protocol = self.machine.reactor.guarded(self.factory.buildProtocol, address)
        if protocol is None:
            transport.refuse()
        else:
            transport.protocol = protocol


class _Attempt:
    """The handshake: a lost one is begun again, a closed port refuses it."""

    def __init__(self, machine: Any, connector: Connector, port: int, own_port: int) -> None:
        self._network = machine.network
        self._clock = machine
        self._connector = connector
        self._port = port
        self._own_port = own_port
        self._up, self._down = self._network.routes(port)
        self._wait_s = FIRST_SYN_S
        self._here: TcpEnd | None = None
        self._again: DelayedCall | None = None
        self.is_over = False

    def knock(self) -> None:
        """Send a SYN, and again without an answer."""
        if not self.is_over:
            self._up.carry(HEADER, self._asked)
            self._again = self._clock.callLater(self._wait_s, self.knock)
            self._wait_s *= 2

    def end(self) -> None:
        """Cancel the attempt."""
        self.is_over = True
        if self._again is not None and self._again.active():
            self._again.cancel()

    def _asked(self) -> None:
        port = self._network.tcp.get(self._port)
        if self._here is None and port is None:
            self._down.carry(HEADER, self._refused)
            return
        if self._here is None:
            self._here = TcpEnd(self._network.clock, self._up)
            there = TcpEnd(self._network.clock, self._down)
            self._here.peer, there.peer = there, self._here
            self._network.note_connection(self._port, (self._here, there))
            # Before any data of the other side, which may cut the connection off immediately.
            self._down.carry(HEADER, self._answered)
            port.accept(there, self._own_port)
        else:
            self._down.carry(HEADER, self._answered)

    def _refused(self) -> None:
        if not self.is_over:
            self._clock.do(self._connector.fail, Refused())

    def _answered(self) -> None:
        here = self._here
        if here is None or self.is_over:
            return
        self.end()
        self._clock.do(self._connector.succeed, here)
        self._up.carry(HEADER, here.peer.establish)


@implementer(IConnector)
class Connector:
    """One attempt to connect, and the resulting connection."""

    def __init__(self, machine: Any, host: str, port: int, factory: Any, timeout_s: float) -> None:
        self.factory = factory
        self.timeout = timeout_s
        self.transport: TcpTransport | None = None
        self.state = "disconnected"
        self._machine = machine
        self._host = host
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
        self._machine.opened[self] = None
        self._own_port = self._machine.network.free_port()
        self._attempt = _Attempt(self._machine, self, self._port, self._own_port)
        self._attempt.knock()
        if self.timeout:
            self._timers.append(self._machine.callLater(self.timeout, self._too_late))

    def stopConnecting(self) -> None:  # noqa: N802 - Twisted's name
        """Give an attempt up."""
        if self.state != "connecting":
            raise RuntimeError("there is no attempt to stop")
        self.fail(UserError())

    def disconnect(self) -> None:
        """Give up the attempt, or close the connection."""
        if self.state == "connecting":
            self.stopConnecting()
        elif self.state == "connected" and self.transport is not None:
            self.transport.loseConnection()

    def getDestination(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        """Return where to."""
        return IPv4Address("TCP", self._host, self._port)

    def cut_off(self) -> None:
        """End without a notification."""
        self._stop()

    def succeed(self, end: TcpEnd) -> None:
        """Become connected."""
        self._stop()
        self.state = "connected"
        self.transport = TcpTransport(self._machine, end, self._own_port, self._port)
        address = self.getDestination()
        protocol = self._machine.reactor.guarded(self.factory.buildProtocol, address)
        if protocol is None:
            self.transport.refuse()
            self.state = "disconnected"
            return
        self.transport.protocol = protocol
        self.transport.on_closed = self.lost
        end.establish()

    def fail(self, error: Exception) -> None:
        """Report that the connection failed."""
        if self.state == "connecting":
            self._stop()
            self.state = "disconnected"
            self.factory.clientConnectionFailed(self, Failure(error))
            if self.state == "disconnected":
                self.factory.doStop()

    def lost(self, reason: Failure) -> None:
        """Handle the loss of the connection."""
        self.state = "disconnected"
        self.factory.clientConnectionLost(self, reason)
        if self.state == "disconnected":
            self.factory.doStop()

    def _too_late(self) -> None:
        self.fail(TimeoutError())

    def _stop(self) -> None:
        self._machine.opened.pop(self, None)
        if self._attempt is not None:
            self._attempt.end()
        for timer in self._timers:
            if timer.active():
                timer.cancel()
        self._timers.clear()
