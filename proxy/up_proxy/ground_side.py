"""Relays data from the ground in control to the aircraft, and handles control lines."""

from typing import TYPE_CHECKING

from up.protocols import binary_line
from up.protocols.control_lease import ControlLease
from up.protocols.proxy_lines import (
    PREFIX,
    PREFIX_BYTE,
    Access,
    ControlGive,
    ControlGranted,
    ControlLost,
    ControlRelease,
    ControlRequest,
    ControlRequested,
    GroundLine,
    KeyRequest,
    parse_line,
)
from up.system.token_bucket import TokenBucket
from up_proxy.connection import IDLE_S, Connection, Owner
from up_proxy.poller import Poller

if TYPE_CHECKING:
    from up_proxy.aircraft import AircraftSession

REQUEST_INTERVAL_S = 1.0
"""Minimum time between two requests of one listener that reach the owner of control."""
HANDSHAKES_HZ, HANDSHAKES_BURST = 1.0, 4
HANDSHAKE_MAX_BYTES = 256
HANDSHAKE = bytes((binary_line.HANDSHAKE,))


class GroundSide(Owner):
    """Owns the ground connections of one aircraft.

    A line is checked when its end arrives, against the owner of control at that moment.
    `connections` is replaced, never changed in place, so that iteration over it stays valid.
    """

    __slots__ = ("_aircraft", "_next_number", "_poller", "connections", "lease", "receivers")

    def __init__(self, aircraft: "AircraftSession", poller: Poller) -> None:
        self._aircraft = aircraft
        self._poller = poller
        self._next_number = 1
        self.lease: ControlLease[Connection] = ControlLease()
        self.connections: tuple[Connection, ...] = ()
        self.receivers: tuple[Connection, ...] = ()
        """Those that the aircraft's lines are sent to from here."""

    def replace(self, connections: tuple[Connection, ...]) -> None:
        """Replace the connections."""
        self.connections = self.receivers = connections

    def admit(self, ground: Connection, access: Access | None, token: str | None) -> Access:
        """Add a ground and return its access; a resume token gains control immediately."""
        ground.owner = self
        ground.number = self._next_number
        self._next_number += 1
        self.replace((*self.connections, ground))
        self._aircraft.report_watchers()
        lease = self.lease
        if access is not Access.COMMAND:
            return Access.LISTEN
        if lease.is_resumed_by(token):
            assert lease.token is not None
            ground.token = lease.token
            displaced = lease.acquire(ground, ground.token)
            if displaced is not None:
                displaced.fail("control was resumed with its token")
            return Access.COMMAND
        if lease.is_free(self._poller.now_s):
            self._grant(ground)
            return Access.COMMAND
        return Access.LISTEN

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Take lines that this proxy received."""
        self._aircraft.ground_bytes += len(lines)
        self.take(connection, lines)

    def take(self, connection: Connection, lines: bytes) -> None:
        """Relay the owner's lines, handle control lines, reject and count the rest."""
        if lines == b"\n" and connection.speaks_hello:
            return  # a heartbeat: it keeps this connection, and would cost the aircraft data
        if PREFIX_BYTE in lines and PREFIX in lines:
            self._relay_mixed(connection, lines)
        elif connection is self.lease.owner:
            self._relay(connection, lines)
        else:
            self._from_listener(connection, lines)

    def on_end(self, connection: Connection, reason: str) -> None:
        """Reserve the owner's lease for its token; a legacy client has none and frees it."""
        self.replace(tuple(each for each in self.connections if each is not connection))
        self._aircraft.report_watchers()
        if self.lease.owner is connection:
            self.lease.disconnect()
        self._poller.tick()
        self._aircraft.announce()

    def keep_paused_alive(self, now_s: float) -> None:
        """Count an owner whose reading is paused as alive, for a limited time."""
        owner = self.lease.owner
        if owner is not None and owner.paused_s is not None and now_s - owner.paused_s < IDLE_S:
            owner.last_rx_s = now_s

    def _relay(self, connection: Connection, lines: bytes) -> None:
        air = self._aircraft.air_lease.owner
        if air is None:
            self._aircraft.rejected_lines += lines.count(b"\n")
        elif not air.relay_paced(lines):
            connection.pause()

    def _from_listener(self, connection: Connection, lines: bytes) -> None:
        if binary_line.HANDSHAKE in lines:
            lines = self._relay_handshakes(connection, lines)
            if not lines:
                return
        if not connection.speaks_hello and self.lease.is_free(self._poller.now_s):
            # A legacy client cannot request control: it takes free control by sending.
            self._grant(connection)
            self._aircraft.announce()
        if connection is self.lease.owner:
            self._relay(connection, lines)
        else:
            self._aircraft.rejected_lines += lines.count(b"\n")

    def _relay_handshakes(self, connection: Connection, lines: bytes) -> bytes:
        """Relay a listener's handshakes at a limited rate, and return its other lines.

        A device that only listens needs a protected session too.
        """
        every = [line + b"\n" for line in lines.split(b"\n")[:-1]]
        if connection.handshakes is None:
            connection.handshakes = TokenBucket(self._poller, HANDSHAKES_HZ, HANDSHAKES_BURST)
        for line in every:
            if not line.startswith(HANDSHAKE):
                continue
            if len(line) <= HANDSHAKE_MAX_BYTES and connection.handshakes.take():
                self._relay(connection, line)
            else:
                self._aircraft.rejected_lines += 1
        return b"".join(each for each in every if not each.startswith(HANDSHAKE))

    def _relay_mixed(self, connection: Connection, lines: bytes) -> None:
        """Handle lines one by one: a control line may change the owner in between."""
        for line in lines.split(b"\n")[:-1]:
            if line.startswith(PREFIX):
                control = parse_line(line) if connection.speaks_hello else None
                if not isinstance(control, GroundLine) or not self._apply(connection, control):
                    self._aircraft.rejected_lines += 1
            elif connection is self.lease.owner:
                self._relay(connection, line + b"\n")
            else:
                self._from_listener(connection, line + b"\n")

    def _apply(self, connection: Connection, control: GroundLine) -> bool:
        """Handle a control line; False: it is rejected."""
        if isinstance(control, KeyRequest):
            self._aircraft.report_watchers()
        elif isinstance(control, ControlRequest):
            self._on_request(connection)
        elif self.lease.owner is not connection:
            return False
        elif isinstance(control, ControlRelease):
            self.lease.release()
            connection.resume()
            connection.send(ControlLost().encode())
        elif isinstance(control, ControlGive):
            heir = self._find(control.to)
            if heir is None:
                return False
            self._grant(heir, notify=True)
        self._aircraft.announce()
        return True

    def _on_request(self, connection: Connection) -> None:
        now_s = self._poller.now_s
        owner = self.lease.owner
        if owner is connection:
            connection.send(ControlGranted(connection.token).encode())
        elif self.lease.is_free(now_s):
            self._grant(connection, notify=True)
        elif now_s - connection.requested_s >= REQUEST_INTERVAL_S:
            connection.requested_s = now_s
            if owner is not None and owner.speaks_hello:
                owner.send(ControlRequested(connection.number).encode())

    def _find(self, number: int) -> Connection | None:
        for ground in self.connections:
            if ground.number == number and ground.failure is None:
                return ground
        return None

    def _grant(self, ground: Connection, notify: bool = False) -> None:
        """Give a ground control, and notify the previous owner."""
        displaced = self.lease.acquire(ground, ground.token or None)
        if displaced is not None:
            displaced.resume()
            if displaced.speaks_hello:
                displaced.send(ControlLost().encode())
        if notify and ground.speaks_hello:
            ground.send(ControlGranted(ground.token).encode())
