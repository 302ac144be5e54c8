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
from up_simulator.in_process.tcp_connection import HEADER, TcpConnection

INITIAL_SYN_RETRY_S = 1.0


@implementer(IListeningPort)
class TcpPort:
    """A port that accepts connections until it is stopped; they outlive it."""

    def __init__(self, host: Any, port: int, factory: Any, interface: str) -> None:
        self.factory = factory
        self.interface = interface
        self.host = host
        self._number = port
        self._is_open = False

    def startListening(self) -> None:  # noqa: N802 - Twisted's name
        network = self.host.network
        self._number = network.bind(network.tcp, self._number, self, self.interface)
        self._is_open = True
        self.host.opened[self] = None
        self.factory.doStart()

    def stopListening(self) -> Deferred[None]:  # noqa: N802 - Twisted's name
        if self._is_open:
            self.cut_off()
            self.factory.doStop()
        return succeed(None)

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return IPv4Address("TCP", self.interface or "0.0.0.0", self._number)

    def cut_off(self) -> None:
        """Close it without a notification."""
        self._is_open = False
        self.host.opened.pop(self, None)
        self.host.network.tcp.pop(self._number, None)


@implementer(IConnector)
class Connector:
    """One attempt to connect, and the resulting connection.

    A lost packet of the handshake is sent again; a closed port refuses it.
    """

    def __init__(self, host: Any, address: str, port: int, factory: Any, timeout_s: float) -> None:
        self.state = "connecting"
        self._host = host
        self._factory = factory
        self._address = IPv4Address("TCP", address, port)
        self._own_port = host.network.free_port()
        self._up, self._down = host.network.routes(port)
        self._timeout_s = timeout_s
        self._wait_s = INITIAL_SYN_RETRY_S
        self._retry: DelayedCall | None = None
        self._timeout: DelayedCall | None = None
        self._connection: TcpConnection | None = None

    def connect(self) -> None:
        """Begin; a connector connects once."""
        self._factory.doStart()
        self._factory.startedConnecting(self)
        self._host.opened[self] = None
        self._send_syn()
        if self._timeout_s:
            self._timeout = self._host.callLater(self._timeout_s, self._fail, TimeoutError())

    def stopConnecting(self) -> None:  # noqa: N802 - Twisted's name
        if self.state != "connecting":
            raise RuntimeError("no attempt is under way")
        self._fail(UserError())

    def getDestination(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return self._address

    def cut_off(self) -> None:
        """End without a notification."""
        self.state = "disconnected"
        self._host.opened.pop(self, None)
        cancel(self._retry)
        cancel(self._timeout)

    def _send_syn(self) -> None:
        self._up.carry(HEADER, self._on_syn)
        self._retry = self._host.callLater(self._wait_s, self._send_syn)
        self._wait_s *= 2

    def _on_syn(self) -> None:
        """Arrive at the other side: its port accepts the connection, or refuses it."""
        listening = self._host.network.tcp.get(self._address.port)
        if self._connection is not None:
            self._down.carry(HEADER, self._on_syn_ack)
        elif listening is None:
            self._down.carry(HEADER, self._on_refused)
        else:
            host, own_port, port = listening.host, self._own_port, self._address.port
            self._connection = TcpConnection(self._host, self._up, own_port, port)
            peer = TcpConnection(host, self._down, port, own_port)
            self._connection.peer, peer.peer = peer, self._connection
            # Before any data of the other side, which may cut the connection off immediately.
            self._down.carry(HEADER, self._on_syn_ack)
            peer.attach()
            host.do(peer.build, listening.factory, IPv4Address("TCP", ADDRESS, own_port))

    def _on_refused(self) -> None:
        if self.state == "connecting":
            self._host.do(self._fail, Refused())

    def _on_syn_ack(self) -> None:
        connection = self._connection
        if connection is None or self.state != "connecting":
            return
        self.cut_off()
        self.state = "connected"
        self._host.do(self._succeed, connection)
        self._up.carry(HEADER, connection.peer.establish)

    def _succeed(self, connection: TcpConnection) -> None:
        connection.attach()
        if connection.build(self._factory, self._address):
            connection.on_closed = self._lost
            connection.establish()
        else:
            self.state = "disconnected"

    def _fail(self, error: Exception) -> None:
        if self.state == "connecting":
            self.cut_off()
            self._factory.clientConnectionFailed(self, Failure(error))
            self._factory.doStop()

    def _lost(self, reason: Failure) -> None:
        self.state = "disconnected"
        self._factory.clientConnectionLost(self, reason)
        self._factory.doStop()
