"""One aircraft at a node of a cluster: its home, or the guest of another node (docs/cluster.md)."""

from typing import TYPE_CHECKING, Any

from twisted.internet.defer import Deferred, DeferredLock

from up.log import Limited, UpLogger
from up.protocols.control_lease import State
from up.protocols.proxy_lines import (
    PREFIX,
    PREFIX_BYTE,
    Access,
    ControlGranted,
    ControlLost,
    HelloError,
    Side,
)
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.lease import Lease, LeaseLostError, Record, phase_of
from up_proxy.aircraft import AircraftSession, relay_to_all, without
from up_proxy.cluster.guest_side import GuestSide
from up_proxy.cluster.home_ground_side import HomeGroundSide
from up_proxy.cluster.node_messages import Beacon, Envelope, GroundLine, GroundList, parse
from up_proxy.cluster.remote_ground import RemoteGround
from up_proxy.cluster.remote_grounds import RemoteGrounds
from up_proxy.connection import Connection
from up_proxy.handshake import new_token, refusal
from up_proxy.poller import Poller

if TYPE_CHECKING:
    from up_proxy.cluster.node import ClusterNode

REPEAT_S = 1.0
"""Period of a guest's list and of a home's beacon, in batches between the two nodes."""
_log = UpLogger.get_logger("proxy")


class ClusterSession(AircraftSession):
    """Relays as an `AircraftSession` while this node is the home, otherwise by `guests`.

    `changes` orders the writes to the entry of the lease; its owner computes the data.
    """

    def __init__(self, node: "ClusterNode", name: str, poller: Poller, limited: Limited) -> None:
        super().__init__(name, poller, limited)
        self._node = node
        self.guests = GuestSide(self, poller)
        self.changes = DeferredLock()
        self.lease: Lease | None = None
        self._claims = 0
        self._home_since_s = 0.0
        self._remotes = RemoteGrounds(self.home_grounds, self._admit, self._send_control)
        # Of many aircraft that came together not all repeat in the same round.
        self._repeated_s = poller.now_s - REPEAT_S * phase_of(name)
        self._beaconed: tuple[bool, int | None] = (False, None)
        base = node.subject(name)
        subjects = self._down, self._up, control = f"{base}.down", f"{base}.up", f"{base}.control"
        self._send_down, self.send_up, self._publish_control = map(node.sender, subjects)
        self._control_newest_s: dict[str, float] = {}
        self._control_sid = node.subscribe(control, self._on_control, self._control_newest_s)
        self._data_sid = node.subscribe(self._down, self._on_down)

    def _new_grounds(self) -> HomeGroundSide:
        return HomeGroundSide(self, self._poller)

    @property
    def is_home(self) -> bool:
        return self.lease is not None

    @property
    def own_grounds(self) -> int:
        return super().own_grounds - len(self._remotes) + len(self.guests.connections)

    def lacks_control(self, now_s: float) -> bool:
        return self.is_home and super().lacks_control(now_s)

    def is_deserted(self, now_s: float) -> bool:
        return not self.guests.connections and not self._claims and super().is_deserted(now_s)

    def close(self) -> None:
        # Of many that end together each waits for its turn.
        self._poller.do_later(self._leave)

    def _leave(self) -> None:
        self._node.forget(self)
        for sid in (self._control_sid, self._data_sid):
            self._node.unsubscribe(sid)
        lease, self.lease = self.lease, None
        if lease is not None:
            self._node.release(lease, None)
        del self.guests, self._remotes
        super().close()

    # The lease.

    async def claim(self, connection: Connection, token: str | None) -> str:
        """Make this node the home for an aircraft with this token; return its token from now on.

        If the connection has ended meanwhile, the aircraft is free for the next one. Raises
        HelloError if another connection has it, UnavailableError, RefusedError.
        """
        self._claims += 1
        try:
            async with self.changes:
                claimed = await self._claim(token)
                if connection.failure is not None and claimed != token:
                    self.air_lease.release()  # for a token that no client has
                return claimed
        finally:
            self._claims -= 1

    async def _claim(self, token: str | None) -> str:
        if self.lease is None:
            return await self._claim_from_others(token)
        if self.air_lease.is_resumed_by(token):
            return token or ""
        if not self.air_lease.is_free(self._poller.tick()):
            raise refusal(token)
        self._take()
        token = new_token()
        await self.write(air=token)
        if (silent := self.air_lease.owner) is not None:
            silent.fail("replaced by another connection of this aircraft")
        self.air_lease.reserve(token, self._poller.tick())
        return token

    def _take(self) -> None:
        quota = self._node.quota
        quota.take(Side.AIRBORNE, is_needed=quota.was_here(self.name))

    async def check_control(self, token: str | None, error: HelloError, *, requests: bool) -> str:
        """Raise the error for a ground that neither has control nor would get it."""
        self._claims += 1
        try:
            data = await self._lease_data()
        finally:
            self._claims -= 1
        owner = data.get("control")
        would_get_it = requests and owner is None and data.get("air") is not None
        if not would_get_it and (token is None or token != owner):
            raise error
        return token or ""

    async def _lease_data(self) -> dict[str, Any]:
        record = await self._node.leases.read(self._node.key(self.name))
        return {} if record is None else record.data

    async def _claim_from_others(self, token: str | None) -> str:
        try:
            self._take()
        except HelloError:
            # An aircraft in flight may change its node; None: a drain released it.
            if token is None or (await self._lease_data()).get("air", "") not in (token, None):
                raise
            return await self._acquire(token)
        try:
            return await self._acquire(token)
        except HelloError:
            self._node.quota.give_back(Side.AIRBORNE)
            raise

    async def _acquire(self, token: str | None) -> str:
        fresh = new_token()

        def decide(record: Record | None) -> dict[str, Any]:
            data = {} if record is None else record.data
            air = data.get("air")
            if air is not None and air == token:
                return data
            if air is not None and record is not None and record.node != self._node.id:
                raise refusal(token)
            return {"air": fresh, "control": data.get("control")}

        lease = await self._node.leases.acquire(self._node.key(self.name), decide, self._on_lease)
        self.lease = lease
        self._become_home()
        return str(lease.data["air"])

    async def write(self, **changed: str | None) -> None:
        """Write the present state with a change. Raises LeaseLostError, UnavailableError."""
        lease = self.lease
        if lease is None:
            raise LeaseLostError(self.name)
        await self._node.leases.update(lease, {**self._data(), **changed})

    def _data(self) -> dict[str, Any]:
        now_s = self._poller.tick()
        control = self.grounds.lease
        return {
            "air": None if self.air_lease.is_free(now_s) else self.air_lease.token or "legacy",
            "control": None if control.state(now_s) is State.FREE else control.token,
        }

    async def _write_changes(self) -> None:
        async with self.changes:
            if self.lease is not None and self._data() != self.lease.data:
                await self.write()

    def _on_lease(self, lease: Lease) -> None:
        if lease is not self.lease:
            return
        if lease.is_lost:
            self.lease = None
            self._become_guest()
        else:
            self._send_beacon()

    def _become_home(self) -> None:
        assert self.lease is not None
        now_s = self._home_since_s = self._poller.tick()
        self._subscribe_data(self._up, self._on_up)
        data = self.lease.data
        self.air_lease.reserve(str(data["air"]), now_s)
        if data["control"]:
            self.grounds.lease.reserve(data["control"], now_s)
        for ground, access in self.guests.take_all():
            self._admit(ground, access, ground.token)
        self._send_beacon()

    def _become_guest(self) -> None:
        """Let another node have the aircraft; the grounds here become its guests."""
        self._subscribe_data(self._down, self._on_down)
        air = self.air_lease.owner
        self.air_lease.release()
        if air is not None:
            air.fail("another node has this aircraft")
        owner = self.grounds.lease.owner
        for ground in self.grounds.connections:
            if not isinstance(ground, RemoteGround):
                ground.resume()
                access = Access.COMMAND if ground is owner else Access.LISTEN
                self.guests.admit(ground, access)
        self.grounds.replace(())
        self.grounds.lease.release()
        self._remotes.clear()
        if self._shown_online:
            self._report("aircraft_left", "aircraft {aircraft} has left this node")
        self._shown_online, self._shown_owner = False, None
        self.send_list()

    def _subscribe_data(self, subject: str, on_message: Any) -> None:
        self._node.unsubscribe(self._data_sid)
        self._data_sid = self._node.subscribe(subject, on_message)

    def _admit(self, ground: Connection, access: Access, token: str) -> None:
        """Admit a ground that knows its access, and send it the change."""
        granted = self.grounds.admit(ground, access, token)
        if access is not Access.COMMAND or not ground.speaks_hello:
            return
        if granted is Access.COMMAND:
            ground.send(ControlGranted(ground.token).encode())
        elif self.home_grounds.granting is not ground:
            ground.send(ControlLost().encode())

    @property
    def home_grounds(self) -> HomeGroundSide:
        assert isinstance(self.grounds, HomeGroundSide)
        return self.grounds

    # Between the nodes.

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        super().on_lines(connection, lines)
        # The guests of a new home list their grounds a moment later.
        is_heard = self._remotes.by_key or self._poller.now_s - self._home_since_s < REPEAT_S
        if is_heard and self.air_lease.owner is connection:
            fence = self.guests.fence if self.lease is None else self.lease.fence
            self._send_down(fence, 0, lines)

    def send_list(self) -> None:
        if self.lease is None:
            self._send_control(0, self.guests.list().encode())

    def refused(self, code: str) -> None:
        self._node.refused[code] += 1

    def announce(self, newcomer: Connection | None = None) -> None:
        super().announce(newcomer)
        if self._beaconed != (self._shown_online, self._shown_owner):
            self._send_beacon()

    def _send_beacon(self) -> None:
        if self.lease is not None:
            self._beaconed = self._shown_online, self._shown_owner
            self._send_control(0, Beacon(*self._beaconed, self._remotes.numbers()).encode())

    def _repeat(self) -> None:
        """Send what holds: to the nodes with grounds, or to the home; if it is unknown to all."""
        if self.lease is not None:
            for node in self._remotes.nodes:
                self._node.batches.add(node, self)
        elif self.guests.connections:
            if (home := self.guests.home) is None:
                self.send_list()
            else:
                self._node.batches.add(home, self)

    def state_for(self, node: str) -> tuple[int, bytes]:
        """Return the fencing number and the list or beacon for a node."""
        if self.lease is None:
            return self.guests.fence, self.guests.list().encode()
        known = self._remotes.numbers(node)
        return self.lease.fence, Beacon(*self._beaconed, known).encode()

    def _send_control(self, ground: int, body: bytes) -> None:
        fence = self.guests.fence if self.lease is None else self.lease.fence
        self._publish_control(fence, ground, body)

    def _on_down(self, message: Envelope) -> None:
        if self.lease is not None or message.fence < self.guests.fence:
            self._node.fenced += 1
            return
        lines = message.body
        if PREFIX_BYTE in lines and PREFIX in lines:
            lines = without(PREFIX, lines)
        self.dropped_lines += relay_to_all(self.guests.connections.values(), lines)

    def _on_up(self, message: Envelope) -> None:
        remote = self._remotes.by_key.get((message.node, message.ground))
        if self.lease is None or message.fence != self.lease.fence or remote is None:
            self._node.fenced += 1
            return
        remote.last_rx_s = self._poller.now_s
        if remote.failure is None and remote.paused_s is None:
            self.grounds.take(remote, message.body)
        else:
            self.rejected_lines += message.body.count(b"\n")

    def on_batched(self, message: Envelope) -> None:
        """Handle a list or a beacon out of a batch."""
        newest_s = self._control_newest_s
        if message.sent_s < newest_s.get(message.node, 0.0):
            self._node.stale += 1
        else:
            newest_s[message.node] = message.sent_s
            self._on_control(message)

    def _on_control(self, message: Envelope) -> None:
        said = parse(message.body)
        if isinstance(said, GroundList):
            if self.lease is not None:
                is_known = message.fence == self.lease.fence
                is_new = self._remotes.update(message.node, said, self._poller.now_s)
                if is_new or not is_known:
                    self.announce()
                    self._send_beacon()
        elif self.lease is not None:
            if isinstance(said, Beacon) and message.fence > self.lease.fence > 0:
                lease, self.lease = self.lease, None
                self._node.release(lease, None)
                self._become_guest()
                self._on_control(message)
        elif message.fence < self.guests.fence:
            self._node.fenced += 1
        elif isinstance(said, GroundLine):
            if said.node == self._node.id:
                self.guests.on_line(message.ground, said.line)
        else:
            is_new = message.fence > self.guests.fence
            self.guests.on_beacon(message.node, message.fence, said, self._node.id)
            if is_new and self.guests.connections:
                self.send_list()

    def sweep(self) -> None:
        now_s = self._poller.now_s
        if now_s - self._repeated_s >= REPEAT_S:
            self._repeated_s = now_s
            self._repeat()
        if self.lease is None:
            self.guests.sweep()
            return
        self._remotes.expire(now_s)
        super().sweep()
        if self.is_deserted(now_s) or self.changes.locked:
            return  # it is about to be released, or written
        if self._data() != self.lease.data:
            Deferred.fromCoroutine(self._write_changes()).addErrback(_ignore_unavailable)

    def kick(self) -> None:
        """End the connections of the aircraft, and free its name and its control."""
        for ground in self.grounds.connections:
            ground.fail("disconnected by up-fleet")
        air = self.air_lease.owner
        self.air_lease.release()
        self.grounds.lease.release()
        if air is not None:
            air.fail("disconnected by up-fleet")

    def drain(self) -> None:
        """Leave the record to any other node."""
        lease, self.lease = self.lease, None
        if lease is not None:
            self._node.release(lease, {**lease.data, "air": None})
            self._become_guest()


def _ignore_unavailable(failure: Any) -> None:
    """The next sweep tries again."""
    if not failure.check(UnavailableError, RefusedError, LeaseLostError):
        _log.failure("a lease failed on a bug", failure, code="proxy_bug")
