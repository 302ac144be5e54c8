"""The phone's sockets: General Message over TCP, Orientation Forward over TCP or UDP."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, Literal

from twisted.application.internet import ClientService
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.error import ConnectError
from twisted.internet.interfaces import IPushProducer, IStreamClientEndpoint
from twisted.internet.protocol import DatagramProtocol, Factory, Protocol
from twisted.protocols.basic import LineOnlyReceiver
from zope.interface import implementer

from up.protocols.line_decoder import MAX_LINE_BYTES
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.harness.user_log import Log
from up_simulator.phone.address import NotFoundError, RaspberryPi
from up_simulator.phone.phone import Phone, Record

CONNECT_S = 2.0
FIRST_RETRY_S, LAST_RETRY_S = 0.5, 2.0

Find = Callable[[], Awaitable[RaspberryPi]]
OrientationBy = Literal["off", "tcp", "udp"]


@implementer(IPushProducer)
class DroppingWriter:
    """Writes to a TCP transport while it takes more; further data is dropped.

    Without this a peer that does not read would fill the memory. ``dropped`` counts.
    """

    def __init__(self, transport: Any) -> None:
        self._transport = transport
        self._is_open = True
        self.dropped = 0
        transport.setTcpNoDelay(True)
        transport.registerProducer(self, True)

    def write(self, data: bytes) -> None:
        if self._is_open:
            self._transport.write(data)
        else:
            self.dropped += 1

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_open = False

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_open = True

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_open = False


class PythonHandset:
    """The phone aboard, in Python.

    Keeps its two links to the Raspberry Pi open, independently and without a limit. ``find`` is
    called before every attempt of the General Message link; the orientation link uses its result.
    A lost link is retried after 0.5 to 2 s; data for a stalled link is dropped, never queued.
    """

    def __init__(
        self,
        reactor: Any,
        flight: FlightDynamics,
        find: Find,
        orientation: OrientationBy,
        log: Log,
        *,
        seed: int = 1,
        identity: str = "",
        record: Record | None = None,
    ) -> None:
        self._reactor = reactor
        self._phone = phone = Phone(
            flight, reactor, seed=seed, identity=identity, log=log, record=record
        )
        self.sensors = phone.sensors
        self.tick = phone.tick
        self.set_battery = phone.set_battery
        self._find = find
        self._log = log
        self._last_text = ""
        self.live: set[Any] = set()
        self._place: RaspberryPi | None = None
        self._udp: Any = None
        self._services = [self._service(self._find_general, lambda: _GeneralLink(phone, self))]
        if orientation == "tcp":
            found = self._find_orientation
            self._services.append(self._service(found, lambda: _OrientationLink(phone, self)))
        self._orientation_by = orientation

    @property
    def is_connected(self) -> bool:
        """Return whether all of its links are open."""
        phone = self._phone
        has_orientation = self._orientation_by == "off" or phone.send_orientation is not None
        return phone.send is not None and has_orientation

    def start(self) -> None:
        for service in self._services:
            service.startService()
        if self._orientation_by == "udp":
            self._udp = self._reactor.listenUDP(0, DatagramProtocol())
            self._phone.send_orientation = self._send_datagram

    async def stop(self) -> None:
        """Abort every link: a peer that does not read delays nothing."""
        self._phone.send_orientation = None
        for transport in list(self.live):
            transport.abortConnection()
        for service in self._services:
            await service.stopService()
        if self._udp is not None:
            await self._udp.stopListening()

    def log(self, text: str, /, *, code: str = "", **fields: Any) -> None:
        """Log a state unless it was the last one logged."""
        if text != self._last_text:
            self._last_text = text
            self._log(text, code=code, **fields)

    async def _find_general(self) -> tuple[str, int]:
        self._place = await self._find()
        return self._place.host, self._place.general_port

    async def _find_orientation(self) -> tuple[str, int]:
        if self._place is None:
            raise NotFoundError("orientation: no address of the Raspberry Pi yet")
        return self._place.host, self._place.orientation_port

    def _send_datagram(self, frame: bytes) -> None:
        if self._place is not None:
            self._udp.write(frame, (self._place.host, self._place.orientation_port))

    def _service(
        self, find: Callable[[], Awaitable[tuple[str, int]]], build: Callable[[], Protocol]
    ) -> ClientService:
        factory: Any = Factory()
        factory.noisy = False
        factory.protocol = build
        endpoint: Any = _FoundEndpoint(self._reactor, find, self.log)
        return ClientService(endpoint, factory, retryPolicy=_retry_s, clock=self._reactor)


@implementer(IStreamClientEndpoint)
class _FoundEndpoint:
    """An endpoint whose address is looked up at every attempt."""

    def __init__(
        self,
        reactor: Any,
        find: Callable[[], Awaitable[tuple[str, int]]],
        log: Log,
    ) -> None:
        self._reactor = reactor
        self._find = find
        self._log = log

    def connect(self, factory: Any) -> Deferred[Any]:
        return Deferred.fromCoroutine(self._connect(factory))

    async def _connect(self, factory: Any) -> Any:
        try:
            host, port = await self._find()
        except NotFoundError as error:
            self._log(f"{error}; trying again", code="phone_not_found", reason=str(error))
            raise
        endpoint = TCP4ClientEndpoint(self._reactor, host, port, timeout=CONNECT_S)
        try:
            return await endpoint.connect(factory)
        except ConnectError as error:
            text = f"no connection to {host}:{port} ({type(error).__name__}); trying again"
            self._log(text, code="phone_not_connected", host=host, port=port)
            raise


class _GeneralLink(LineOnlyReceiver):
    """One connection of the General Message link."""

    delimiter = b"\n"
    MAX_LENGTH = MAX_LINE_BYTES

    def __init__(self, phone: Phone, link: PythonHandset) -> None:
        self._phone = phone
        self._link = link

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        transport: Any = self.transport
        peer = transport.getPeer()
        text = f"connected to {peer.host}:{peer.port}"
        self._link.log(text, code="phone_connected", host=peer.host, port=peer.port)
        self._link.live.add(transport)
        self._phone.connected(DroppingWriter(transport).write)

    def lineReceived(self, line: bytes) -> None:  # noqa: N802 - Twisted's name
        self._phone.line_received(line)

    def connectionLost(self, reason: Any = None) -> None:  # noqa: N802 - Twisted's name
        self._link.live.discard(self.transport)
        self._phone.disconnected()
        self._link.log("connection lost", code="phone_disconnected")


class _OrientationLink(Protocol):
    """One connection of the orientation link."""

    def __init__(self, phone: Phone, link: PythonHandset) -> None:
        self._phone = phone
        self._link = link

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self._link.live.add(self.transport)
        self._phone.send_orientation = DroppingWriter(self.transport).write

    def connectionLost(self, reason: Any = None) -> None:  # noqa: N802 - Twisted's name
        self._link.live.discard(self.transport)
        self._phone.send_orientation = None


def _retry_s(attempt: int) -> float:
    return min(LAST_RETRY_S, FIRST_RETRY_S * 2.0 ** min(attempt, 10))
