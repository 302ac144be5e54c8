"""The handshake of a connection: from its first byte to its seat or its refusal."""

import secrets
from collections.abc import Callable

from up_proxy.connection import Connection, Owner
from up_proxy.fleet import Fleet
from up_proxy.hello import (
    CODES,
    HELLO_MAX_BYTES,
    HELLO_TIMEOUT_S,
    MALFORMED,
    SILENCE_S,
    TAKEN,
    THESIS_AIRCRAFT,
    TOKEN,
    Hello,
    HelloError,
    SeatKind,
    Side,
    error_line,
    ok_line,
    parse_hello,
)
from up_proxy.leaving import Leaving
from up_proxy.poller import Poller
from up_proxy.silent import Silent


def new_token() -> str:
    """Return an unguessable resume token."""
    return secrets.token_hex(16)


class Opening:
    """Owns the connections of one side until their first line identifies them."""

    def __init__(
        self,
        side: Side,
        fleet: Fleet,
        poller: Poller,
        draw_token: Callable[[], str] = new_token,
    ) -> None:
        self._side = side
        self._fleet = fleet
        self._poller = poller
        self._draw_token = draw_token
        self._leaving = Leaving()
        self._since_s: dict[Connection, float] = {}
        self.refused = dict.fromkeys(CODES, 0)

    def begin(self, connection: Connection) -> None:
        """Take a new connection."""
        connection.owner = self
        self._since_s[connection] = self._poller.now_s

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Check the first line; the seat's owner gets the rest."""
        del self._since_s[connection]
        if lines.startswith(b"{"):
            rest = lines
            self._admit_thesis(connection, silent=False)
        else:
            first, _, rest = lines.partition(b"\n")
            try:
                self._admit(connection, parse_hello(first + b"\n", self._side))
            except HelloError as error:
                self._refuse(connection, error)
        if rest and connection.failure is None:
            connection.owner.on_lines(connection, rest)

    def on_half_line(self, connection: Connection) -> None:
        """Recognise a thesis client by its first byte; bound the length of a hello."""
        half = connection.half
        if half is None:
            return
        if half.starts_with(b"{"):
            del self._since_s[connection]
            self._admit_thesis(connection, silent=False)
        elif len(half) >= HELLO_MAX_BYTES:
            del self._since_s[connection]
            self._refuse(
                connection, HelloError(MALFORMED, f"a hello is at most {HELLO_MAX_BYTES} bytes")
            )

    def on_drained(self, connection: Connection) -> None:
        """Do nothing: the send queue is empty."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Remove it."""
        self._since_s.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        """Accept silent clients as thesis clients, refuse slow ones, close refused ones."""
        for connection, since_s in list(self._since_s.items()):
            if connection.half is None:
                if now_s - since_s >= SILENCE_S:
                    del self._since_s[connection]
                    self._admit_thesis(connection, silent=True)
            elif now_s - since_s >= HELLO_TIMEOUT_S:
                del self._since_s[connection]
                self._refuse(
                    connection, HelloError(MALFORMED, f"no hello within {HELLO_TIMEOUT_S:g} s")
                )
        self._leaving.sweep(now_s)

    def _refuse(self, connection: Connection, error: HelloError) -> None:
        self.refused[error.code] += 1
        self._leaving.begin(connection, self._poller.now_s)
        connection.refuse(error_line(error), error.reason)

    def _admit(self, connection: Connection, hello: Hello) -> None:
        party = self._fleet.party(hello.aircraft)
        now_s = self._poller.now_s
        connection.speaks_hello = True
        if self._side is Side.AIRBORNE:
            seat = party.aircraft.air_seat
            resumed = seat.is_resumed_by(hello.token)
            if not resumed and not seat.is_free(now_s):
                raise HelloError(
                    TAKEN if hello.token is None else TOKEN,
                    "an aircraft of this name is connected"
                    if hello.token is None
                    else "this token is not that of the aircraft that is connected",
                )
            connection.token = seat.token if resumed and seat.token else self._draw_token()
            connection.owner = party.air
            connection.tell(ok_line(hello.aircraft, SeatKind.AIR, connection.token))
            party.air.seat(connection)
        else:
            self._fleet.check_room(party.aircraft, now_s, hello.token)
            connection.token = self._draw_token()
            connection.owner = party.ground
            kind = party.ground.admit(connection, hello.seat or SeatKind.LISTEN, hello.token)
            connection.tell(ok_line(hello.aircraft, kind, connection.token))
            party.aircraft.announce(now_s, newcomer=connection)

    def _admit_thesis(self, connection: Connection, silent: bool) -> None:
        try:
            party = self._fleet.party(THESIS_AIRCRAFT)
            seated: Owner
            if self._side is Side.AIRBORNE:
                if not party.aircraft.air_seat.is_free(self._poller.now_s):
                    raise HelloError(TAKEN, "an aircraft of this name is connected")
                seated = party.air
                party.air.seat(connection)
            else:
                self._fleet.check_room(party.aircraft, self._poller.now_s)
                seated = party.ground
                party.ground.admit(connection, SeatKind.COMMAND, None)
                party.aircraft.announce(self._poller.now_s, newcomer=connection)
        except HelloError as error:
            # A thesis client would read an error line as a malformed message: it gets none.
            self.refused[error.code] += 1
            self._leaving.begin(connection, self._poller.now_s)
            connection.fail(error.reason)
            return
        connection.owner = Silent(seated, self) if silent else seated
