"""The beginning of a connection: from its first byte to its seat, or to its refusal."""

import secrets
from collections.abc import Callable
from typing import Protocol

from up_proxy.connection import Connection, Owner
from up_proxy.control import PREFIX
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
from up_proxy.poller import Poller

LEAVE_S = 2.0
"""A refused connection has this long to read why."""


def new_token() -> str:
    """Return a resume token that nobody guesses."""
    return secrets.token_hex(16)


class Leaving:
    """Owns refused connections: hears nothing more from them."""

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Ignore them."""

    def on_half_line(self, connection: Connection) -> None:
        """Ignore it."""
        connection.half = None

    def on_drained(self, connection: Connection) -> None:
        """Nothing follows."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Nothing was held."""


class Seated(Owner, Protocol):
    """An owner in whose hands a connection stays."""


class Silent:
    """Owns a connection that was taken for a thesis client because it said nothing.

    A hello that the network delayed past the silence is still heard: it is then the first thing
    that the connection says.
    """

    def __init__(self, seated: Seated, opening: "Opening") -> None:
        self._seated = seated
        self._opening = opening

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Go on as what the first line shows."""
        if lines.startswith(PREFIX):
            self._seated.on_end(connection, "said hello late")
            self._opening.begin(connection)
            self._opening.on_lines(connection, lines)
        else:
            connection.owner = self._seated
            self._seated.on_lines(connection, lines)

    def on_half_line(self, connection: Connection) -> None:
        """Wait for the rest of the line."""

    def on_drained(self, connection: Connection) -> None:
        """Pass it on."""
        self._seated.on_drained(connection)

    def on_end(self, connection: Connection, reason: str) -> None:
        """Pass it on."""
        self._seated.on_end(connection, reason)


class Opening:
    """Owns the connections of one side until their first line has said what they are."""

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
        self._left_s: dict[Connection, float] = {}
        self.refused = dict.fromkeys(CODES, 0)

    def begin(self, connection: Connection) -> None:
        """Take a new connection."""
        connection.owner = self
        self._since_s[connection] = self._poller.now_s

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Judge the first line; what follows belongs to the seat."""
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
        """Recognise a thesis client by its first byte; bound a hello."""
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
        """Nothing waits for it."""

    def on_end(self, connection: Connection, reason: str) -> None:
        """Forget it."""
        self._since_s.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        """Take the silent for thesis clients, refuse the slow, close the refused."""
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
        for connection, left_s in list(self._left_s.items()):
            if connection.failure is not None:
                del self._left_s[connection]
            elif now_s - left_s >= LEAVE_S:
                connection.fail("refused")

    def _refuse(self, connection: Connection, error: HelloError) -> None:
        self.refused[error.code] += 1
        connection.owner = self._leaving
        connection.half = None
        self._left_s[connection] = self._poller.now_s
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
            self._fleet.check_room(party.aircraft)
            connection.token = self._draw_token()
            connection.owner = party.ground
            kind = party.ground.admit(connection, hello.seat or SeatKind.LISTEN, hello.token)
            connection.tell(ok_line(hello.aircraft, kind, connection.token))
            party.aircraft.announce(now_s, newcomer=connection)

    def _admit_thesis(self, connection: Connection, silent: bool) -> None:
        try:
            party = self._fleet.party(THESIS_AIRCRAFT)
            seated: Seated
            if self._side is Side.AIRBORNE:
                if not party.aircraft.air_seat.is_free(self._poller.now_s):
                    raise HelloError(TAKEN, "an aircraft of this name is connected")
                seated = party.air
                party.air.seat(connection)
            else:
                self._fleet.check_room(party.aircraft)
                seated = party.ground
                party.ground.admit(connection, SeatKind.COMMAND, None)
                party.aircraft.announce(self._poller.now_s, newcomer=connection)
        except HelloError as error:
            # A thesis client would take an error line for a broken message: it gets none.
            self.refused[error.code] += 1
            connection.owner = self._leaving
            connection.fail(error.reason)
            return
        connection.owner = Silent(seated, self) if silent else seated
