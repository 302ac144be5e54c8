"""Relays data from the ground in control to the aircraft, and handles control lines."""

from up_proxy.aircraft import Aircraft
from up_proxy.connection import IDLE_S, Connection
from up_proxy.control import (
    LISTEN,
    PREFIX,
    Control,
    SeatGive,
    SeatRelease,
    SeatRequest,
    asked_line,
    command_line,
    parse_control,
)
from up_proxy.hello import SeatKind
from up_proxy.poller import Poller

ASK_INTERVAL_S = 1.0
"""Minimum time between two requests of one listener that reach the holder."""


class GroundSide:
    """Owns the ground connections of one aircraft.

    A line is checked when its end arrives, against the seat's holder at that moment.
    """

    __slots__ = ("_aircraft", "_poller")

    def __init__(self, aircraft: Aircraft, poller: Poller) -> None:
        self._aircraft = aircraft
        self._poller = poller

    def admit(self, ground: Connection, asks: SeatKind, token: str | None) -> SeatKind:
        """Add a ground and return its seat; a resume token takes the seat immediately."""
        aircraft = self._aircraft
        aircraft.add_ground(ground)
        seat = aircraft.command_seat
        if asks is not SeatKind.COMMAND:
            return SeatKind.LISTEN
        if seat.is_resumed_by(token):
            assert seat.token is not None
            ground.token = seat.token
            displaced = seat.take(ground, ground.token)
            if displaced is not None:
                displaced.fail("its seat was taken over with its token")
            return SeatKind.COMMAND
        if seat.is_free(self._poller.now_s):
            self._seat(ground)
            return SeatKind.COMMAND
        return SeatKind.LISTEN

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Relay the holder's lines, handle control lines, drop and count the rest."""
        aircraft = self._aircraft
        aircraft.ground_bytes += len(lines)
        if PREFIX in lines:
            self._relay_mixed(connection, lines)
        elif connection is aircraft.command_seat.occupant:
            self._relay(connection, lines)
        else:
            self._from_listener(connection, lines)

    def on_half_line(self, connection: Connection) -> None:
        """Wait for the rest of the line."""

    def on_drained(self, connection: Connection) -> None:
        """Do nothing: the ground's send queue is empty."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Keep the holder's seat for its token; a thesis client has none and frees it."""
        aircraft = self._aircraft
        aircraft.remove_ground(connection)
        seat = aircraft.command_seat
        if seat.occupant is connection:
            seat.leave()
            if seat.token is None:
                seat.release()
        aircraft.announce(self._poller.tick())

    def keep_paused_alive(self, ground: Connection, now_s: float) -> None:
        """Count a ground whose reading is paused as alive, for a limited time."""
        if ground.paused_s is not None and now_s - ground.paused_s < IDLE_S:
            ground.heard_s = now_s

    def _relay(self, connection: Connection, lines: bytes) -> None:
        aircraft = self._aircraft
        air = aircraft.air_seat.occupant
        if air is None:
            aircraft.unheard_lines += lines.count(b"\n")
        elif not air.relay_paced(lines):
            connection.pause()

    def _from_listener(self, connection: Connection, lines: bytes) -> None:
        seat = self._aircraft.command_seat
        if not connection.speaks_hello and seat.is_free(self._poller.now_s):
            # A thesis client cannot request the seat: it takes a free one by sending.
            self._seat(connection)
            self._aircraft.announce(self._poller.now_s)
            self._relay(connection, lines)
        else:
            self._aircraft.unheard_lines += lines.count(b"\n")

    def _relay_mixed(self, connection: Connection, lines: bytes) -> None:
        """Handle lines one by one: a control line may change the seat in between."""
        for line in lines.split(b"\n")[:-1]:
            if not line.startswith(PREFIX):
                if connection is self._aircraft.command_seat.occupant:
                    self._relay(connection, line + b"\n")
                else:
                    self._from_listener(connection, line + b"\n")
                continue
            control = parse_control(line) if connection.speaks_hello else None
            if control is None:
                self._aircraft.unheard_lines += 1
            else:
                self._obey(connection, control)

    def _obey(self, connection: Connection, control: Control) -> None:
        now_s = self._poller.now_s
        aircraft = self._aircraft
        holds = aircraft.command_seat.occupant is connection
        if isinstance(control, SeatRequest):
            self._on_request(connection, now_s)
        elif holds and isinstance(control, SeatRelease):
            aircraft.command_seat.release()
            connection.resume()
            connection.tell(LISTEN)
        elif holds and isinstance(control, SeatGive):
            heir = aircraft.ground(control.to)
            if heir is None:
                aircraft.unheard_lines += 1
            else:
                self._seat(heir, tell=True)
        else:
            aircraft.unheard_lines += 1
        aircraft.announce(now_s)

    def _on_request(self, connection: Connection, now_s: float) -> None:
        seat = self._aircraft.command_seat
        if seat.occupant is connection:
            connection.tell(command_line(connection.token))
        elif seat.is_free(now_s):
            self._seat(connection, tell=True)
        elif now_s - connection.asked_s >= ASK_INTERVAL_S:
            connection.asked_s = now_s
            holder = seat.occupant
            if holder is not None and holder.speaks_hello:
                holder.tell(asked_line(connection.number))

    def _seat(self, ground: Connection, tell: bool = False) -> None:
        """Give a ground control, and notify the previous holder."""
        displaced = self._aircraft.command_seat.take(ground, ground.token or None)
        if displaced is ground:
            displaced = None
        if displaced is not None:
            displaced.resume()
            if displaced.speaks_hello:
                displaced.tell(LISTEN)
        if tell and ground.speaks_hello:
            ground.tell(command_line(ground.token))
