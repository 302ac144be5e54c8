"""One aircraft by name: its airborne connection, its grounds, the two leases."""

from collections.abc import Collection

from up.log import Limited, UpLogger
from up.protocols.binary_line import PACKED
from up.protocols.control_lease import ALIVE_S, ControlLease
from up.protocols.proxy_lines import PREFIX, PREFIX_BYTE, AircraftPresence, ControlOwner, Watchers
from up_proxy.connection import IDLE_S, Connection, Owner
from up_proxy.ground_side import GroundSide
from up_proxy.listener import KEEPALIVE_IDLE_S
from up_proxy.poller import Poller

WATCH_INTERVAL_S = 0.5
"""Minimum time between two lines to an aircraft about its watchers."""
UNWATCHED_IDLE_S = 12
"""An aircraft without grounds sends only every 10 s: no probes in between."""
PULSE_S, UNWATCHED_PULSE_S = 5.0, 10.0
"""An aircraft that was sent nothing for this long gets an empty line: it finds a dead path so."""
_PACKED = bytes((PACKED,))
_log = UpLogger.get_logger("proxy")


class AircraftSession(Owner):
    """Owns the airborne connection of one aircraft and relays it to all its grounds."""

    __slots__ = (
        "__weakref__",
        "_is_watch_due",
        "_limited",
        "_poller",
        "_shown_online",
        "_shown_owner",
        "_watch_told_s",
        "air_bytes",
        "air_lease",
        "dropped_lines",
        "ground_bytes",
        "grounds",
        "name",
        "rejected_lines",
    )

    def __init__(self, name: str, poller: Poller, limited: Limited) -> None:
        self.name = name
        self._poller = poller
        self._limited = limited
        self.air_lease: ControlLease[Connection] = ControlLease()
        self.grounds = self._new_grounds()
        self.air_bytes = 0
        self.ground_bytes = 0
        self.dropped_lines = 0
        """Lines to slow grounds that newer lines replaced."""
        self.rejected_lines = 0
        """Lines from grounds without control, or for an absent aircraft."""
        self._watch_told_s = -WATCH_INTERVAL_S
        self._is_watch_due = False
        self._shown_online = False
        self._shown_owner: int | None = None

    def _new_grounds(self) -> GroundSide:
        return GroundSide(self, self._poller)

    def close(self) -> None:
        """End its use: it is deserted."""
        # They refer to each other: without this only a full garbage collection would free it.
        del self.grounds

    @property
    def own_grounds(self) -> int:
        return len(self.grounds.connections)

    def lacks_control(self, now_s: float) -> bool:
        """Return whether it is online and no ground has control."""
        return self.is_online(now_s) and self.grounds.lease.is_free(now_s)

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
        self.air_lease.alive_s = ALIVE_S
        self._watch_told_s = -WATCH_INTERVAL_S
        self.report_watchers()
        self.announce()

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Relay to every ground, without control lines: grounds trust those of the proxy."""
        if self.air_lease.owner is not connection:
            return
        self.air_bytes += len(lines)
        if PREFIX_BYTE in lines and (lines.startswith(PREFIX) or b"\n" + PREFIX in lines):
            before = lines.count(b"\n")
            lines = without(PREFIX, lines)
            self.dropped_lines += before - lines.count(b"\n")
            if not lines:
                return
        self.dropped_lines += relay_to_all(self.grounds.receivers, lines)

    def on_drained(self, connection: Connection) -> None:
        if self.air_lease.owner is connection:
            self._resume_grounds()

    def on_end(self, connection: Connection, reason: str) -> None:
        """Reserve the aircraft's lease for its token."""
        if self.air_lease.owner is connection:
            self.air_lease.alive_s = ALIVE_S
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

    def report_watchers(self, *, is_news: bool = True) -> None:
        """Tell the aircraft what its grounds are: at a change, and when one of them lacks a key.

        Without grounds the aircraft sends rarely, and its lease lasts as long as a
        connection without data. The first ground's line counts as a byte of the aircraft, so that
        it has time to answer.
        """
        self._is_watch_due |= is_news
        air, now_s = self.air_lease.owner, self._poller.now_s
        if air is None or not air.reads_packed or not self._is_watch_due:
            return
        if now_s - self._watch_told_s < WATCH_INTERVAL_S:
            return
        self._watch_told_s, self._is_watch_due = now_s, False
        grounds = self.grounds.connections
        if grounds and self.air_lease.alive_s != ALIVE_S:
            air.last_rx_s = now_s
        self.air_lease.alive_s = ALIVE_S if grounds else IDLE_S
        air.expect_silence(KEEPALIVE_IDLE_S if grounds else UNWATCHED_IDLE_S)
        packed = all(each.reads_packed for each in grounds)
        attitude = packed and all(each.reads_attitude for each in grounds)
        air.send(Watchers(len(grounds), int(packed), int(attitude)).encode())

    def sweep(self) -> None:
        """Send the due lines: to the grounds, and to an aircraft that knows `Watchers`."""
        self.announce()
        self.report_watchers(is_news=False)
        air, now_s = self.air_lease.owner, self._poller.now_s
        # A silent aircraft gets none, so that its connection is found idle.
        if air is None or not air.reads_packed or now_s - air.last_rx_s > IDLE_S:
            return
        if now_s - air.last_tx_s >= (PULSE_S if self.grounds.connections else UNWATCHED_PULSE_S):
            air.send(b"\n")

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


def relay_to_all(grounds: Collection[Connection], lines: bytes) -> int:
    """Send lines of an aircraft; return how many old ones were dropped to make room.

    Packed lines go to the grounds that read them.
    """
    if not grounds:
        return 0
    plain = lines if PACKED not in lines else without(_PACKED, lines)
    dropped = 0
    for ground in grounds:
        readable = lines if ground.reads_packed else plain
        if readable:
            dropped += ground.relay(readable)
    return dropped


def without(prefix: bytes, lines: bytes) -> bytes:
    """Return the whole lines that do not begin with `prefix`."""
    # Split at LF alone; bytes.splitlines would also split at CR.
    return b"".join(each + b"\n" for each in lines.split(b"\n")[:-1] if not each.startswith(prefix))
