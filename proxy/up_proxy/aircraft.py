"""One aircraft by name: its airborne connection, its grounds, the two leases."""

from up.log import Limited, UpLogger
from up.protocols.control_lease import ControlLease
from up.protocols.proxy_lines import PREFIX, AircraftPresence, ControlOwner
from up_proxy.connection import Connection, Owner
from up_proxy.ground_side import GroundSide
from up_proxy.poller import Poller

_log = UpLogger.get_logger("proxy")


class AircraftSession(Owner):
    """Owns the airborne connection of one aircraft and relays it to all its grounds."""

    def __init__(self, name: str, poller: Poller, limited: Limited) -> None:
        self.name = name
        self._poller = poller
        self._limited = limited
        self.air_lease: ControlLease[Connection] = ControlLease()
        self.grounds = GroundSide(self, poller)
        self.air_bytes = 0
        self.ground_bytes = 0
        self.dropped_lines = 0
        """Lines to slow grounds that newer lines replaced."""
        self.rejected_lines = 0
        """Lines from grounds without control, or for an absent aircraft."""
        self._shown_online = False
        self._shown_owner: int | None = None

    def is_online(self, now_s: float) -> bool:
        return self.air_lease.live_owner(now_s) is not None

    def is_deserted(self, now_s: float) -> bool:
        """Return whether it has neither a connection nor a lease reserved for a token."""
        return (
            self.air_lease.owner is None
            and not self.grounds.connections
            and self.air_lease.is_free(now_s)
            and self.grounds.lease.is_free(now_s)
        )

    def admit(self, air: Connection) -> None:
        """Make a connection the aircraft's; the previous one is dropped."""
        air.owner = self
        displaced = self.air_lease.acquire(air, air.token or None)
        if displaced is not None:
            displaced.fail("replaced by another connection of this aircraft")
        self.announce()

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Relay to every ground, without control lines: grounds trust those of the proxy."""
        if self.air_lease.owner is not connection:
            return
        self.air_bytes += len(lines)
        if PREFIX in lines and (lines.startswith(PREFIX) or b"\n" + PREFIX in lines):
            # Split at LF alone; bytes.splitlines would also split at CR.
            every = lines.split(b"\n")[:-1]
            relayed = [line for line in every if not line.startswith(PREFIX)]
            self.dropped_lines += len(every) - len(relayed)
            if not relayed:
                return
            lines = b"\n".join(relayed) + b"\n"
        for ground in self.grounds.connections:
            dropped = ground.relay(lines)
            if dropped:
                self.dropped_lines += dropped

    def on_drained(self, connection: Connection) -> None:
        if self.air_lease.owner is connection:
            self._resume_grounds()

    def on_end(self, connection: Connection, reason: str) -> None:
        """Reserve the aircraft's lease for its token."""
        if self.air_lease.owner is connection:
            self.air_lease.disconnect()
            self._resume_grounds()
            self._poller.tick()
            self.announce()

    def announce(self, newcomer: Connection | None = None) -> None:
        """Send the grounds the changes, and a new ground the current state."""
        now_s = self._poller.now_s
        air = self.air_lease.live_owner(now_s)
        presence = AircraftPresence(air is not None)
        if presence.is_online != self._shown_online:
            self._shown_online = presence.is_online
            if air is None:
                self._report("aircraft_offline", "aircraft {aircraft} is offline")
            else:
                text = "aircraft {aircraft} is online from {host}"
                self._report("aircraft_online", text, host=air.host)
            self._send_to_others(presence.encode(), newcomer)
        ground = self.grounds.lease.live_owner(now_s)
        owner = ControlOwner(None if ground is None else ground.number)
        if owner.number != self._shown_owner:
            self._shown_owner = owner.number
            if ground is None:
                self._report("control_free", "no ground controls {aircraft}")
            else:
                self._report(
                    "control_granted",
                    "ground {number} from {host} controls {aircraft}",
                    number=ground.number,
                    host=ground.host,
                )
            self._send_to_others(owner.encode(), newcomer)
        if newcomer is not None and newcomer.speaks_hello:
            newcomer.send(presence.encode())
            newcomer.send(owner.encode())

    def _report(self, code: str, text: str, **fields: object) -> None:
        key = (self.name, code.partition("_")[0])
        self._limited.log(_log.info, text, key=key, code=code, aircraft=self.name, **fields)

    def _send_to_others(self, line: bytes, newcomer: Connection | None) -> None:
        for ground in self.grounds.connections:
            if ground.speaks_hello and ground is not newcomer:
                ground.send(line)

    def _resume_grounds(self) -> None:
        for ground in self.grounds.connections:
            ground.resume()
