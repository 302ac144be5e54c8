"""The sockets and the serial device of MAVLink, and the sessions of their clients."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from twisted.internet.interfaces import IPushProducer
from twisted.internet.protocol import DatagramProtocol, Factory, Protocol
from twisted.internet.task import LoopingCall
from twisted.logger import Logger
from zope.interface import implementer

from up.protocols.general_message import GeneralMessage
from up.protocols.serial_line import SerialLine
from up.protocols.serial_port import open_serial
from up.system.udp import listen_udp
from up_mavlink.address import SERIAL, TCP_SERVER, UDP_CLIENT, Address
from up_mavlink.aircraft import Aircraft, Port
from up_mavlink.codec import Codec
from up_mavlink.dialect import load_dialect
from up_mavlink.personas import Persona
from up_mavlink.session import Session
from up_mavlink.signing import Signing

MAX_CLIENTS = 8
SILENT_S = 30.0
"""A UDP client that sends nothing for this long is forgotten."""
MAX_CHUNK = 4096
"""Bytes that are parsed of one read."""
SERIAL_PENDING = 2048


@dataclass(frozen=True, slots=True)
class Settings:
    """What one endpoint is; ``key`` signs and is required of every packet, None: plain."""

    address: Address
    persona: Persona
    system_id: int = 1
    key: bytes | None = None
    ground_id: int | None = None


class Endpoint:
    """Serves the clients of one address from ``start`` to ``stop``.

    ``port`` carries their Commands. ``number`` is the bound port. Raises UserError without
    pymavlink, CannotListenError from ``start``.
    """

    log = Logger()

    def __init__(self, reactor: Any, settings: Settings, port: Port) -> None:
        self.settings = settings
        self.counters: Counter[str] = Counter()
        self.aircraft = Aircraft(reactor, port, settings.persona, settings.system_id)
        self.sessions: dict[Hashable, Session] = {}
        self.number = settings.address.port
        self._reactor = reactor
        self._m = load_dialect()
        self._signing = None if settings.key is None else Signing(settings.key)
        self._transport: Any = None
        self._loop = LoopingCall(self._on_moment)
        self._loop.clock = reactor

    @property
    def has_ground(self) -> bool:
        """Return whether a ground station is connected: its heartbeats arrive."""
        return any(each.has_ground for each in self.sessions.values())

    @property
    def content(self) -> Mapping[str, int]:
        return {"clients": len(self.sessions), **self.counters}

    def on_frame(self, content: Mapping[str, Any], beacon: int | None) -> None:
        self.aircraft.on_frame(content, beacon)
        for session in list(self.sessions.values()):
            session.on_frame()

    def on_message(self, message: GeneralMessage) -> None:
        self.aircraft.on_message(message)

    def start(self) -> None:
        address = self.settings.address
        if address.kind == SERIAL:
            self._start_serial(address)
        elif address.kind == TCP_SERVER:
            factory: Any = Factory.forProtocol(partial(_Connection, self))
            factory.noisy = False
            self._transport = self._reactor.listenTCP(address.port, factory, interface=address.host)
            self.number = self._transport.getHost().port
        else:
            is_client = address.kind == UDP_CLIENT
            peer = (address.host, address.port) if is_client else None
            protocol = _Datagrams(self, peer)
            host = "" if is_client else address.host
            number = 0 if is_client else address.port
            self._transport = listen_udp(self._reactor, number, protocol, host)
            if not is_client:
                self.number = self._transport.getHost().port
        self._loop.start(1.0, now=False)

    async def stop(self) -> None:
        if self._loop.running:
            self._loop.stop()
        for key in list(self.sessions):
            self.close(key)
        self.aircraft.stop()
        transport, self._transport = self._transport, None
        if isinstance(transport, SerialLine):
            transport.stop()
        elif transport is not None:
            await transport.stopListening()

    def codec(self) -> Codec:
        return Codec(self._m, self.settings.system_id, self.counters, self._signing)

    def open(self, key: Hashable, send: Callable[[bytes], object], codec: Codec) -> Session | None:
        """Return the session of a new client; None and counted if there are too many."""
        if len(self.sessions) >= MAX_CLIENTS:
            self.counters["too_many_clients"] += 1
            return None
        session = Session(
            self._m, self._reactor, self.aircraft, codec, send, self.counters,
            self.settings.ground_id,
        )  # fmt: skip
        self.sessions[key] = session
        return session

    def close(self, key: Hashable) -> None:
        session = self.sessions.pop(key, None)
        if session is not None:
            session.stop()

    def _start_serial(self, address: Address) -> None:
        line: SerialLine = SerialLine(
            self._reactor,
            lambda: open_serial(address.host, address.port),
            on_bytes=lambda data: session.on_bytes(data) if session is not None else None,
            on_opened=lambda: None,
            on_lost=lambda why: self.log.warn("{device}: {why}", device=address.host, why=why),
            on_open_failed=lambda why: self.log.error("{why}", why=why, code="mavlink_serial"),
            pending_limit=SERIAL_PENDING,
        )
        session = self.open(address, line.write, self.codec())
        self._transport = line
        line.start()

    def _on_moment(self) -> None:
        now_s = self._reactor.seconds()
        is_server = self.settings.address.kind == "udpin"
        for key, session in list(self.sessions.items()):
            if is_server and now_s - session.received_s > SILENT_S:
                self.close(key)
            else:
                session.on_moment()


class _Datagrams(DatagramProtocol):
    """A UDP server's clients, or the one ``peer`` that a UDP client sends to."""

    def __init__(self, endpoint: Endpoint, peer: tuple[str, int] | None) -> None:
        self._endpoint = endpoint
        self._peer = peer
        self._strangers = endpoint.codec()

    def startProtocol(self) -> None:  # noqa: N802 - Twisted's name
        if self._peer is not None:
            self._open(self._peer, self._endpoint.codec())

    def datagramReceived(self, data: bytes, addr: tuple[str, int]) -> None:  # noqa: N802
        endpoint = self._endpoint
        session = endpoint.sessions.get(addr)
        if session is not None:
            session.on_bytes(data)
            return
        if self._peer is not None:
            endpoint.counters["foreign"] += 1
            return
        # Only a valid packet, signed where that is required, makes a client.
        messages = self._strangers.parse(data)
        if messages:
            session = self._open(addr, endpoint.codec())
            if session is not None:
                session.on_messages(messages)
        self._strangers = self._strangers if messages else endpoint.codec()

    def _open(self, addr: tuple[str, int], codec: Codec) -> Session | None:
        def send(packet: bytes) -> None:
            transport: Any = self.transport
            if transport is not None:
                transport.write(packet, addr)

        return self._endpoint.open(addr, send, codec)


@implementer(IPushProducer)
class _Connection(Protocol):
    """A TCP client; while it does not read, packets to it are dropped."""

    def __init__(self, endpoint: Endpoint) -> None:
        self._endpoint = endpoint
        self._session: Session | None = None
        self._is_paused = False

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        transport: Any = self.transport
        transport.registerProducer(self, True)
        transport.setTcpNoDelay(True)
        self._session = self._endpoint.open(self, self._send, self._endpoint.codec())
        if self._session is None:
            transport.abortConnection()

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        for at in range(0, len(data), MAX_CHUNK):
            if self._session is not None:
                self._session.on_bytes(data[at : at + MAX_CHUNK])

    def connectionLost(self, reason: Any = None) -> None:  # noqa: N802 - Twisted's name
        self._endpoint.close(self)
        self._session = None

    def pauseProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_paused = True

    def resumeProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_paused = False

    def stopProducing(self) -> None:  # noqa: N802 - Twisted's name
        self._is_paused = True

    def _send(self, packet: bytes) -> None:
        if self._is_paused:
            self._endpoint.counters["unsent"] += 1
        else:
            transport: Any = self.transport
            transport.write(packet)
