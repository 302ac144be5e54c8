"""One aircraft by name: its airborne connection, its grounds, the two seats."""

from up_proxy.connection import Connection
from up_proxy.control import OFFLINE, ONLINE, holder_line
from up_proxy.journal import Journal
from up_proxy.seat import Seat


class Aircraft:
    """The connections of one aircraft, and its counters.

    `grounds` is replaced, never changed in place, so that iteration over it stays valid.
    """

    __slots__ = (
        "_journal",
        "_next_number",
        "_shown_holder",
        "_shown_online",
        "air_bytes",
        "air_seat",
        "command_seat",
        "dropped_lines",
        "ground_bytes",
        "grounds",
        "name",
        "unheard_lines",
    )

    def __init__(self, name: str, journal: Journal) -> None:
        self.name = name
        self._journal = journal
        self.air_seat: Seat[Connection] = Seat()
        self.command_seat: Seat[Connection] = Seat()
        self.grounds: tuple[Connection, ...] = ()
        self.air_bytes = 0
        self.ground_bytes = 0
        self.dropped_lines = 0
        """Lines to slow grounds that newer lines replaced."""
        self.unheard_lines = 0
        """Lines from grounds without the seat, or for an absent aircraft."""
        self._next_number = 1
        self._shown_online = False
        self._shown_holder: int | None = None

    def is_online(self, now_s: float) -> bool:
        """Return whether the airborne side is connected and alive."""
        return self.air_seat.holder(now_s) is not None

    def is_deserted(self, now_s: float) -> bool:
        """Return whether it has neither a connection nor a seat kept for a token."""
        return (
            self.air_seat.occupant is None
            and not self.grounds
            and self.air_seat.is_free(now_s)
            and self.command_seat.is_free(now_s)
        )

    def add_ground(self, ground: Connection) -> None:
        """Number a ground and add it as a listener."""
        ground.number = self._next_number
        self._next_number += 1
        self.grounds = (*self.grounds, ground)

    def remove_ground(self, ground: Connection) -> None:
        """Remove a ground; its seat is handled separately."""
        self.grounds = tuple(each for each in self.grounds if each is not ground)

    def ground(self, number: int) -> Connection | None:
        """Return the ground with this number."""
        for ground in self.grounds:
            if ground.number == number and ground.failure is None:
                return ground
        return None

    def announce(self, now_s: float, newcomer: Connection | None = None) -> None:
        """Send the grounds the changes, and a new ground the current state."""
        air = self.air_seat.holder(now_s)
        online = air is not None
        if online != self._shown_online:
            self._shown_online = online
            if air is not None:
                self._journal.on_online(self.name, air.host)
            else:
                self._journal.on_offline(self.name)
            self._tell_others(ONLINE if online else OFFLINE, newcomer)
        holder = self.command_seat.holder(now_s)
        number = None if holder is None else holder.number
        if number != self._shown_holder:
            self._shown_holder = number
            if holder is not None:
                self._journal.on_holder(self.name, holder.number, holder.host)
            else:
                self._journal.on_no_holder(self.name)
            self._tell_others(holder_line(number), newcomer)
        if newcomer is not None and newcomer.speaks_hello:
            newcomer.tell(ONLINE if online else OFFLINE)
            newcomer.tell(holder_line(number))

    def _tell_others(self, line: bytes, newcomer: Connection | None) -> None:
        for ground in self.grounds:
            if ground.speaks_hello and ground is not newcomer:
                ground.tell(line)
