"""Datagrams in memory, as listenUDP gives."""

from __future__ import annotations

from typing import Any

from twisted.internet.address import IPv4Address
from twisted.internet.defer import Deferred, succeed
from twisted.internet.interfaces import IListeningPort, IUDPTransport
from zope.interface import implementer

from up_simulator.in_process.network import ADDRESS

HEADER = 28
MAX_DATAGRAM_BYTES = 65507


@implementer(IListeningPort, IUDPTransport)
class UdpPort:
    """A port for datagrams; those without a receiver vanish."""

    def __init__(self, host: Any, port: int, protocol: Any, interface: str) -> None:
        self.protocol = protocol
        self.interface = interface
        self._host = host
        self._number = port
        self._peer: tuple[str, int] | None = None
        self._is_open = False

    def startListening(self) -> None:  # noqa: N802 - Twisted's name
        network = self._host.network
        self._number = network.bind(network.udp, self._number, self, self.interface)
        self._is_open = True
        self._host.opened[self] = None
        self.protocol.makeConnection(self)

    def stopListening(self) -> Deferred[None]:  # noqa: N802 - Twisted's name
        if self._is_open:
            self.cut_off()
            self.protocol.doStop()
        return succeed(None)

    def write(self, packet: bytes, addr: tuple[str, int] | None = None) -> None:
        target = addr or self._peer
        if not self._is_open or target is None or len(packet) > MAX_DATAGRAM_BYTES:
            return
        network = self._host.network
        route = network.datagram_route(self._number, target[1])
        source = (ADDRESS, self._number)
        route.carry(HEADER + len(packet), _arrive, network, target[1], bytes(packet), source)

    def connect(self, host: str, port: int) -> None:
        self._peer = (host, port)

    def getHost(self) -> IPv4Address:  # noqa: N802 - Twisted's name
        return IPv4Address("UDP", self.interface or "0.0.0.0", self._number)

    def setBroadcastAllowed(self, enabled: bool) -> None:  # noqa: N802 - Twisted's name
        """Do nothing: there is one host to reach."""

    def cut_off(self) -> None:
        self._is_open = False
        self._host.opened.pop(self, None)
        self._host.network.udp.pop(self._number, None)

    def receive(self, packet: bytes, source: tuple[str, int]) -> None:
        self._host.do(self._host.reactor.guarded, self._on_datagram, packet, source)

    def _on_datagram(self, packet: bytes, source: tuple[str, int]) -> None:
        if self._is_open:
            self.protocol.datagramReceived(packet, source)


def _arrive(network: Any, port: int, packet: bytes, source: tuple[str, int]) -> None:
    listening = network.udp.get(port)
    if listening is not None:
        listening.receive(packet, source)
