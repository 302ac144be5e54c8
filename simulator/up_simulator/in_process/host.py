"""One program's reactor: all that the program opened can be cut off in one call."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from ipaddress import ip_address
from typing import TYPE_CHECKING, Any

from twisted.internet.address import IPv4Address, IPv6Address
from twisted.internet.base import DelayedCall
from twisted.internet.interfaces import (
    IHostnameResolver,
    IReactorPluggableNameResolver,
    IReactorTCP,
    IReactorUDP,
)
from zope.interface import implementer

from up.system.clock import cancel
from up_simulator.in_process.tcp_ports import Connector, TcpPort
from up_simulator.in_process.udp_port import UdpPort

if TYPE_CHECKING:
    from up_simulator.in_process.reactor import SimulatedReactor

PRUNE_AT = 256


@implementer(IReactorTCP, IReactorUDP, IReactorPluggableNameResolver)
class SimulatedHost:
    """The reactor that a program sees; its sockets stay in this process, at 127.0.0.1.

    ``cut_off`` kills the program: no timer, descriptor or port of it is left.
    """

    def __init__(self, reactor: SimulatedReactor) -> None:
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
