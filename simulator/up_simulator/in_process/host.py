"""One program's reactor: all that the program opened can be cut off in one call."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from ipaddress import ip_address
from typing import TYPE_CHECKING, Any

from twisted.internet.address import IPv4Address, IPv6Address
from twisted.internet.base import DelayedCall
from twisted.internet.defer import Deferred, succeed
from twisted.internet.interfaces import (
    IHostnameResolver,
    IListeningPort,
    IReactorPluggableNameResolver,
    IReactorTCP,
    IReactorUDP,
    IUDPTransport,
)
from zope.interface import implementer

from up.system.clock import cancel
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.tcp_ports import Connector, TcpPort

if TYPE_CHECKING:
    from up_simulator.in_process.reactor import SimulatedReactor

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


PRUNE_AT = 256


@implementer(IReactorTCP, IReactorUDP, IReactorPluggableNameResolver)
class SimulatedHost:
    """The reactor that a program sees; its sockets stay in this process, at 127.0.0.1.

    ``cut_off`` kills the program: no timer, descriptor or port of it is left.
    """

    def __init__(self, reactor: SimulatedReactor, name: str) -> None:
        self.name = name
        self.running = True
        self.reactor = reactor
        self.network = reactor.network
        self.nameResolver = LiteralResolver()
        self.opened: dict[Any, None] = {}
        self.seconds = reactor.seconds
        self._calls: list[DelayedCall] = []
        self._descriptors: dict[Any, None] = {}

    def callLater(  # noqa: N802 - Twisted's name
        self, delay: float, callable: Callable[..., object], *args: object, **kw: object
    ) -> DelayedCall:
        """Call later; ignored after the end of this program."""
        call = self.reactor.callLater(delay, callable, *args, **kw)
        self._calls.append(call)
        if len(self._calls) > PRUNE_AT:
            self._calls = [each for each in self._calls if each.active()]
        return call

    def callFromThread(self, callable: Callable[..., Any], *args: object, **kw: object) -> None:  # noqa: N802
        self.reactor.call_from_thread(partial(self.do, partial(callable, *args, **kw)))

    def start_thread(self, work: Callable[[], None]) -> None:
        """Do the work of a disk immediately: a flight must not depend on this computer's disk."""
        work()

    def addReader(self, reader: Any) -> None:  # noqa: N802 - Twisted's name
        self._descriptors[reader] = None
        self.reactor.add_reader(reader)

    def removeReader(self, reader: Any) -> None:  # noqa: N802 - Twisted's name
        self.reactor.remove_reader(reader)

    def addWriter(self, writer: Any) -> None:  # noqa: N802 - Twisted's name
        self._descriptors[writer] = None
        self.reactor.add_writer(writer)

    def removeWriter(self, writer: Any) -> None:  # noqa: N802 - Twisted's name
        self.reactor.remove_writer(writer)

    def removeAll(self) -> list[Any]:  # noqa: N802 - Twisted's name
        descriptors, self._descriptors = list(self._descriptors), {}
        for each in descriptors:
            self.reactor.remove_reader(each)
            self.reactor.remove_writer(each)
        return descriptors

    def listenTCP(  # noqa: N802 - Twisted's name
        self, port: int, factory: Any, backlog: int = 50, interface: str = ""
    ) -> TcpPort:
        """Listen in memory; raises CannotListenError if the port is in use."""
        listening = TcpPort(self, port, factory, interface)
        listening.startListening()
        return listening

    def connectTCP(  # noqa: N802 - Twisted's name
        self,
        host: str,
        port: int,
        factory: Any,
        timeout: float = 30,
        bindAddress: Any = None,  # noqa: N803 - Twisted's name
    ) -> Connector:
        connector = Connector(self, host, port, factory, timeout)
        connector.connect()
        return connector

    def listenUDP(  # noqa: N802 - Twisted's name
        self,
        port: int,
        protocol: Any,
        interface: str = "",
        maxPacketSize: int = 8192,  # noqa: N803 - Twisted's name
    ) -> UdpPort:
        """Receive datagrams in memory; raises CannotListenError if the port is in use."""
        listening = UdpPort(self, port, protocol, interface)
        listening.startListening()
        return listening

    def do(self, call: Callable[..., Any], *arguments: Any) -> None:
        """Call into the program while it lives."""
        if self.running:
            call(*arguments)

    def cut_off(self) -> None:
        """Kill the program: its system closes all that it leaves behind."""
        self.running = False
        for call in self._calls:
            cancel(call)
        self._calls.clear()
        self.removeAll()
        opened, self.opened = self.opened, {}
        for each in opened:
            each.cut_off()


@implementer(IHostnameResolver)
class LiteralResolver:
    """Resolves addresses only: a name would have to be looked up outside this process."""

    def resolveHostName(  # noqa: N802 - Twisted's name
        self,
        resolutionReceiver: Any,  # noqa: N803 - Twisted's name
        hostName: str,  # noqa: N803 - Twisted's name
        portNumber: int = 0,  # noqa: N803 - Twisted's name
        addressTypes: Any = None,  # noqa: N803 - Twisted's name
        transportSemantics: str = "TCP",  # noqa: N803 - Twisted's name
    ) -> Any:
        """Resolve a literal address to itself, any other name to nothing."""
        resolutionReceiver.resolutionBegan(self)
        try:
            address = ip_address(hostName)
        except ValueError:
            pass
        else:
            kind = IPv4Address if address.version == 4 else IPv6Address
            resolutionReceiver.addressResolved(kind("TCP", str(address), portNumber))
        resolutionReceiver.resolutionComplete()
        return self

    def cancel(self) -> None:
        """Do nothing: every request is already answered."""
