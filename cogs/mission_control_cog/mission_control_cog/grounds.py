"""The ground stations connected to the aircraft itself, and the one that has control."""

from collections.abc import Callable
from random import Random, SystemRandom
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Factory, Protocol

from mission_control_cog.ground_connection import GroundConnection
from up.commands.command_link import CommandLink
from up.commands.refusal import Code
from up.protocols.binary_line import HANDSHAKE
from up.protocols.control_lease import ControlLease
from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.protocols.proxy_lines import Accepted, Access, Hello
from up.system.clock import Clock
from up.system.peer_filter import PeerFilter

MAX_STATIONS = 8
_NO_CONTROL = "another ground station has control"


class Grounds(Factory):
    """One station has control, as at the proxy: the first one, while it is alive.

    A station that only listens takes free control by sending. Stations beyond ``MAX_STATIONS``
    are refused.
    """

    noisy = False

    def __init__(
        self,
        clock: Clock,
        peers: PeerFilter,
        aircraft: str,
        *,
        open_link: Callable[[Callable[[bytes], object]], CommandLink],
        on_message: Callable[[GeneralMessage, CommandLink], object],
        on_malformed: Callable[[MalformedMessage, CommandLink], object],
        on_owner: Callable[[str], object],
        on_binary: Callable[[bytes, Callable[[bytes], object], str], object] | None = None,
        requires_protection: bool = False,
        random: Random | None = None,
    ) -> None:
        self.dropped = 0
        self.too_many = 0
        self.requires_protection = requires_protection
        self._clock = clock
        self._peers = peers
        self._aircraft = aircraft
        self._open_link = open_link
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_owner = on_owner
        self._on_binary = on_binary
        self._random = random or SystemRandom()
        self._stations: dict[GroundConnection, CommandLink] = {}
        self._lease: ControlLease[GroundConnection] = ControlLease()
        self._all_closed: Deferred[None] | None = None

    def __len__(self) -> int:
        return len(self._stations)

    def send(self, message: bytes) -> bool:
        """Send to every station in order; False if none accepted it."""
        return any([each.send(message) for each in self._stations if each.is_known])

    def send_newest(self, message: bytes) -> bool:
        """Send to every station, replacing an unsent message."""
        return any([each.send_newest(message) for each in self._stations if each.is_known])

    async def close(self) -> None:
        if self._stations:
            self._all_closed = Deferred()
            for station in list(self._stations):
                station.close()
            await self._all_closed

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # noqa: N802 - Twisted's name
        """Return the connection of a permitted peer; None refuses it."""
        host: Any = getattr(addr, "host", "")
        return self.build() if self._peers.permits(host) else None

    def build(self) -> GroundConnection | None:
        """Return the protocol of a new connection, or None if there are too many."""
        if len(self._stations) >= MAX_STATIONS:
            return None
        return GroundConnection(
            self._clock,
            on_hello=self._accept,
            on_message=self._message,
            on_malformed=self._malformed,
            on_connected=self._connected,
            on_lost=self._lost,
            on_binary=None if self._on_binary is None else self._binary,
        )

    def _connected(self, station: GroundConnection) -> None:
        self._stations[station] = self._open_link(station.send)

    def _accept(self, station: GroundConnection, hello: Hello) -> Accepted:
        if self._lease.is_resumed_by(hello.token):
            station.token = hello.token
            displaced = self._acquire(station)
            if displaced is not None:
                displaced.close()
        else:
            station.token = self._random.randbytes(16).hex()
            if hello.access is Access.COMMAND and self._is_free():
                self._acquire(station)
        access = Access.COMMAND if station is self._lease.owner else Access.LISTEN
        return Accepted(self._aircraft, access, station.token or "")

    def _message(self, station: GroundConnection, message: GeneralMessage) -> None:
        if station is not self._lease.owner and self._is_free():
            self._acquire(station)
        link = self._stations[station]
        if station is self._lease.owner:
            self._on_message(message, link)
            return
        self.dropped += 1
        link.nack(message.id, Code.FORBIDDEN, _NO_CONTROL)

    def _binary(self, station: GroundConnection, line: bytes) -> None:
        """Hand on a handshake of any station, and a protected message with the rule for others."""
        assert self._on_binary is not None
        is_message = line[0] != HANDSHAKE
        if is_message and station is not self._lease.owner and self._is_free():
            self._acquire(station)
        is_refused = is_message and station is not self._lease.owner
        self.dropped += is_refused
        self._on_binary(line, station.send, _NO_CONTROL if is_refused else "")

    def _malformed(self, station: GroundConnection, fault: MalformedMessage) -> None:
        if station is self._lease.owner:
            self._on_malformed(fault, self._stations[station])
        else:
            self.dropped += 1

    def _lost(self, station: GroundConnection, reason: str) -> None:
        del self._stations[station]
        self.too_many += station.bucket.refused
        if station is self._lease.owner:
            self._lease.disconnect()
            self._on_owner("")
        if not self._stations and self._all_closed is not None:
            self._all_closed.callback(None)
            self._all_closed = None

    def _is_free(self) -> bool:
        return self._lease.is_free(self._clock.seconds())

    def _acquire(self, station: GroundConnection) -> GroundConnection | None:
        displaced = self._lease.acquire(station, station.token)
        self._on_owner(station.peer)
        return displaced
