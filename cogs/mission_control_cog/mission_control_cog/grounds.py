"""The ground stations connected to the aircraft itself, and the one that has control."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from random import Random, SystemRandom
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.interfaces import IAddress
from twisted.internet.protocol import Factory, Protocol

from mission_control_cog.ground_connection import GroundConnection
from up.commands.command_link import CommandLink
from up.commands.refusal import Code
from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.system.clock import Clock
from up.system.peer_filter import PeerFilter

ALIVE_S = 3.0
"""A holder that is silent for longer may lose the seat to a newcomer."""
STATIONS_LIMIT = 8


class Grounds:
    """One control seat, as at the proxy: the first station takes it and keeps it while alive.

    The seat of a disconnected station is kept for its token for ``ALIVE_S``. A station that only
    listens takes a free seat by sending. Stations beyond ``STATIONS_LIMIT`` are refused.
    """

    def __init__(
        self,
        clock: Clock,
        peers: PeerFilter,
        aircraft: str,
        *,
        open_link: Callable[[Callable[[bytes], object]], CommandLink],
        on_message: Callable[[GeneralMessage, CommandLink], object],
        on_malformed: Callable[[MalformedMessage, CommandLink], object],
        on_holder: Callable[[str], object],
        random: Random | None = None,
    ) -> None:
        self.dropped = 0
        self.too_many = 0
        self.peers = peers
        self.factory = _Factory(self)
        self._clock = clock
        self._aircraft = aircraft
        self._open_link = open_link
        self._on_message = on_message
        self._on_malformed = on_malformed
        self._on_holder = on_holder
        self._random = random or SystemRandom()
        self._stations: dict[GroundConnection, CommandLink] = {}
        self._holder: GroundConnection | None = None
        self._kept_token = ""
        self._kept_until_s = 0.0
        self._all_closed: Deferred[None] | None = None

    def __len__(self) -> int:
        """Return how many stations are connected."""
        return len(self._stations)

    def send(self, message: bytes) -> bool:
        """Send to every station in order; False if none accepted it."""
        return any([each.send(message) for each in self._stations if each.is_known])

    def send_newest(self, message: bytes) -> bool:
        """Send to every station, replacing an unsent message."""
        return any([each.send_newest(message) for each in self._stations if each.is_known])

    async def close(self) -> None:
        """Close every connection."""
        if self._stations:
            self._all_closed = Deferred()
            for station in list(self._stations):
                station.close()
            await self._all_closed

    def build(self) -> GroundConnection | None:
        """Return the protocol of a new connection, or None if there are too many."""
        if len(self._stations) >= STATIONS_LIMIT:
            return None
        return GroundConnection(
            self._clock,
            on_hello=self._greet,
            on_message=self._message,
            on_malformed=self._malformed,
            on_connected=self._connected,
            on_lost=self._lost,
        )

    def _connected(self, station: GroundConnection) -> None:
        self._stations[station] = self._open_link(station.send)

    def _greet(self, station: GroundConnection, wants_seat: bool, token: str) -> bytes:
        """Return the answer to a hello."""
        kept = self._kept_token if self._holder is None else self._holder.token
        if token and kept and secrets.compare_digest(token, kept):
            self._resume(station, token)
        elif not station.token:
            station.token = self._random.randbytes(16).hex()
            if wants_seat and self._is_free():
                self._seat(station)
        seat = "command" if station is self._holder else "listen"
        answer = f"UP1 ok aircraft={self._aircraft} seat={seat} token={station.token}\n"
        return answer.encode("ascii")

    def _resume(self, station: GroundConnection, token: str) -> None:
        displaced = self._holder
        station.token = token
        self._seat(station)
        if displaced is not None and displaced is not station:
            displaced.close()

    def _message(self, station: GroundConnection, message: GeneralMessage) -> None:
        if station is not self._holder and self._is_free():
            self._seat(station)
        link = self._stations[station]
        if station is self._holder:
            self._on_message(message, link)
            return
        self.dropped += 1
        link.nack(message.id, Code.FORBIDDEN, "another ground station commands; this one listens")

    def _malformed(self, station: GroundConnection, fault: MalformedMessage) -> None:
        if station is self._holder:
            self._on_malformed(fault, self._stations[station])
        else:
            self.dropped += 1

    def _lost(self, station: GroundConnection, why: str) -> None:
        del self._stations[station]
        self.too_many += station.bucket.refused
        if station is self._holder:
            self._holder = None
            self._kept_token = station.token
            self._kept_until_s = station.heard_s + ALIVE_S
            self._on_holder("")
        if not self._stations and self._all_closed is not None:
            self._all_closed.callback(None)
            self._all_closed = None

    def _is_free(self) -> bool:
        now_s = self._clock.seconds()
        if self._holder is not None:
            return now_s - self._holder.heard_s > ALIVE_S
        # Without a token the station cannot resume the seat: it is free immediately.
        return not self._kept_token or now_s > self._kept_until_s

    def _seat(self, station: GroundConnection) -> None:
        self._holder = station
        self._kept_token = ""
        self._on_holder(station.peer)


class _Factory(Factory):
    """Builds a connection for a permitted peer."""

    noisy = False

    def __init__(self, grounds: Grounds) -> None:
        self._grounds = grounds

    def buildProtocol(self, addr: IAddress | None) -> Protocol | None:  # noqa: N802 - Twisted's name
        host: Any = getattr(addr, "host", "")
        return self._grounds.build() if self._grounds.peers.permits(host) else None
