"""The grounds of an aircraft at a node that is not the aircraft's home."""

from typing import TYPE_CHECKING

from up.protocols.proxy_lines import (
    PREFIX,
    Access,
    AircraftPresence,
    ControlGranted,
    ControlLost,
    ControlOwner,
    parse_line,
)
from up_proxy.cluster.node_messages import Beacon, GroundList, ListedGround
from up_proxy.connection import Connection, Owner
from up_proxy.poller import Poller

if TYPE_CHECKING:
    from up_proxy.cluster.session import ClusterSession

HOME_LIMIT_S = 3.0
"""A home that sends no beacon for this long counts as gone."""
_FRESH_S = 1.5
"""After this time without its beacon the list goes to all nodes, as another one may be the home."""


class GuestSide(Owner):
    """Owns the grounds, and sends their lines to the home; what the home answers goes to them.

    `accesses`: what each ground has, or still requests.
    """

    def __init__(self, session: "ClusterSession", poller: Poller) -> None:
        self._session = session
        self._poller = poller
        self._next_number = 1
        self._presence = AircraftPresence(False)
        self._control = ControlOwner(None)
        self._beacon_s = -HOME_LIMIT_S
        self.connections: dict[int, Connection] = {}
        self.accesses: dict[int, Access] = {}
        self._asking: set[int] = set()
        """Grounds that the home does not know yet."""
        self.fence = 0
        """The highest fencing number seen."""
        self._home = ""

    @property
    def has_home(self) -> bool:
        return self._poller.now_s - self._beacon_s < HOME_LIMIT_S

    @property
    def home(self) -> str | None:
        """The home's node, if its beacon is fresh."""
        return self._home if self._poller.now_s - self._beacon_s < _FRESH_S else None

    def admit(self, ground: Connection, access: Access) -> None:
        ground.owner = self
        ground.number, self._next_number = self._next_number, self._next_number + 1
        self.connections = {**self.connections, ground.number: ground}
        self.accesses[ground.number] = access
        self._asking.add(ground.number)

    def greet(self, ground: Connection) -> None:
        ground.send(self._presence.encode())
        ground.send(self._control.encode())

    def take_all(self) -> list[tuple[Connection, Access]]:
        """Return all grounds with their access, and keep none."""
        taken = [(each, self.accesses[number]) for number, each in self.connections.items()]
        self.connections, self.accesses = {}, {}
        self._asking.clear()
        return taken

    def list(self) -> GroundList:
        now_s = self._poller.now_s
        return GroundList(
            tuple(
                ListedGround(
                    number,
                    self.accesses[number],
                    each.token,
                    each.reads_packed,
                    each.reads_attitude,
                    each.host,
                    max(0.0, now_s - each.last_rx_s),
                )
                for number, each in self.connections.items()
            )
        )

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        self._session.ground_bytes += len(lines)
        if lines == b"\n" and connection.speaks_hello:
            return
        if self.has_home:
            self._session.send_up(self.fence, connection.number, lines)
        else:
            self._session.rejected_lines += lines.count(b"\n")

    def on_end(self, connection: Connection, reason: str) -> None:
        number = connection.number
        self.connections = {n: each for n, each in self.connections.items() if n != number}
        self.accesses.pop(number, None)
        self._asking.discard(number)
        self._session.send_list()

    def on_beacon(self, home: str, fence: int, beacon: Beacon, me: str) -> None:
        """Follow a home; the request of a ground that it admitted is over."""
        self._home, self.fence, self._beacon_s = home, fence, self._poller.now_s
        for number in self._asking.intersection(beacon.known.get(me, ())):
            self._asking.discard(number)
            self.accesses[number] = Access.LISTEN
        self._show(AircraftPresence(beacon.online), ControlOwner(beacon.owner))

    def on_line(self, number: int, line: bytes) -> None:
        """Pass a line of the home on to a ground; one that is no control line ends it."""
        ground = self.connections.get(number)
        if ground is None:
            return
        if not line.startswith(PREFIX):
            ground.fail(line.decode("ascii", "replace"))
            return
        news = parse_line(line)
        if isinstance(news, ControlGranted):
            self._asking.discard(number)
            self.accesses[number], ground.token = Access.COMMAND, news.token
        elif isinstance(news, ControlLost):
            self.accesses[number] = Access.LISTEN
        if ground.speaks_hello:
            ground.send(line)

    def sweep(self) -> None:
        if not self.has_home:
            self._show(AircraftPresence(False), ControlOwner(None))

    def _show(self, presence: AircraftPresence, control: ControlOwner) -> None:
        news = b"" if presence == self._presence else presence.encode()
        news += b"" if control == self._control else control.encode()
        self._presence, self._control = presence, control
        if news:
            for ground in self.connections.values():
                if ground.speaks_hello:
                    ground.send(news)
