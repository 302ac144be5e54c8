"""The handshake of a connection: from its first byte to its role or its refusal."""

import secrets

from up.protocols.proxy_lines import (
    CODES,
    HELLO_MAX_BYTES,
    MALFORMED,
    NAME,
    PREFIX,
    TAKEN,
    TOKEN,
    Accepted,
    Access,
    Hello,
    HelloError,
    Refused,
    Side,
    parse_hello,
)
from up_proxy.aircraft import AircraftSession
from up_proxy.connection import Connection, Owner
from up_proxy.poller import Poller
from up_proxy.registry import AircraftRegistry
from up_proxy.tenant_quota import TenantQuota

HELLO_TIMEOUT_S = 5.0
"""Time limit for completing a hello."""
SILENCE_S = 1.0
"""A connection that sends nothing for this long is a legacy client."""
LINGER_S = 2.0
"""A refused connection has this long to read the reason."""
LINGER_BYTES = 1_000_000
"""A peer that sends more than this while it lingers is closed immediately."""
_CLIENT_HELLO = b"\x16\x03"
"""The first bytes of a TLS connection."""
LEGACY_AIRCRAFT = "default"
"""The aircraft of clients that never send a name."""


def new_token() -> str:
    """Return an unguessable resume token."""
    return secrets.token_hex(16)


def refusal(token: str | None) -> HelloError:
    """Return why an aircraft whose name another connection has is refused."""
    if token is None:
        return HelloError(TAKEN, "an aircraft of this name is connected")
    return HelloError(TOKEN, "this token is not that of the connected aircraft")


class Handshake(Owner):
    """Owns the connections of one side until their first line identifies them."""

    def __init__(
        self, side: Side, registry: AircraftRegistry, poller: Poller, quota: TenantQuota
    ) -> None:
        self._side = side
        self._registry = registry
        self._poller = poller
        self._quota = quota
        self._lingering = LingeringClose()
        self._since_s: dict[Connection, float] = {}
        self.refused = dict.fromkeys(CODES, 0)

    def begin(self, connection: Connection) -> None:
        connection.owner = self
        self._since_s[connection] = self._poller.now_s

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        """Check the first line; the new owner gets the rest."""
        del self._since_s[connection]
        if lines.startswith(b"{"):
            rest = lines
            self._admit_legacy(connection, silent=False)
        else:
            first, _, rest = lines.partition(b"\n")
            try:
                self._admit(connection, parse_hello(first + b"\n", self._side))
            except HelloError as error:
                self._refuse(connection, error)
        if rest and connection.failure is None:
            connection.owner.on_lines(connection, rest)

    def on_partial_line(self, connection: Connection) -> None:
        """Recognise a legacy client by its first byte; bound the length of a hello."""
        partial = connection.partial
        if partial is None:
            return
        if partial.starts_with(_CLIENT_HELLO):
            self._refuse(connection, HelloError(MALFORMED, "this port does not speak TLS"))
        elif partial.starts_with(b"{"):
            del self._since_s[connection]
            self._admit_legacy(connection, silent=False)
        elif len(partial) >= HELLO_MAX_BYTES:
            reason = f"a hello is at most {HELLO_MAX_BYTES} bytes"
            self._refuse(connection, HelloError(MALFORMED, reason))

    def on_end(self, connection: Connection, reason: str) -> None:
        self._since_s.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        """Accept silent clients as legacy clients, refuse slow ones, close refused ones."""
        for connection, since_s in list(self._since_s.items()):
            if connection.partial is None:
                if now_s - since_s >= SILENCE_S:
                    del self._since_s[connection]
                    self._admit_legacy(connection, silent=True)
            elif now_s - since_s >= HELLO_TIMEOUT_S:
                reason = f"no hello within {HELLO_TIMEOUT_S:g} s"
                self._refuse(connection, HelloError(MALFORMED, reason))
        self._lingering.sweep(now_s)

    def _refuse(self, connection: Connection, error: HelloError) -> None:
        self._linger(connection, error)
        connection.refuse(Refused(error.code, error.reason).encode(), error.reason)

    def _admit(self, connection: Connection, hello: Hello) -> None:
        session = self._registry.session(hello.aircraft)
        connection.speaks_hello = True
        connection.reads_packed = hello.packed
        connection.reads_attitude = hello.attitude
        if self._side is Side.AIRBORNE:
            check_name(connection, hello.aircraft)
            lease = session.air_lease
            resumed = lease.is_resumed_by(hello.token)
            if not resumed:
                if not lease.is_free(self._poller.now_s):
                    raise refusal(hello.token)
                self._take_aircraft(session)
            connection.token = lease.token if resumed and lease.token else new_token()
            connection.send(Accepted(hello.aircraft, Access.AIR, connection.token).encode())
            session.admit(connection)
        else:
            self._registry.check_room(session, hello.token)
            if not session.grounds.lease.is_resumed_by(hello.token):
                self._take_ground(session, hello.access)
            connection.token = new_token()
            access = session.grounds.admit(connection, hello.access, hello.token)
            connection.send(Accepted(hello.aircraft, access, connection.token).encode())
            session.announce(newcomer=connection)

    def _take_aircraft(self, session: AircraftSession) -> None:
        self._quota.take(Side.AIRBORNE, is_needed=self._quota.was_here(session.name))

    def _take_ground(self, session: AircraftSession, access: Access | None) -> None:
        gets_control = access is not Access.LISTEN and session.lacks_control(self._poller.now_s)
        self._quota.take(Side.GROUND, is_needed=gets_control)

    def _admit_legacy(self, connection: Connection, silent: bool) -> None:
        try:
            session = self._registry.session(LEGACY_AIRCRAFT)
            if self._side is Side.AIRBORNE:
                check_name(connection, LEGACY_AIRCRAFT)
                if not session.air_lease.is_free(self._poller.now_s):
                    raise refusal(None)
                self._take_aircraft(session)
                session.admit(connection)
            else:
                self._registry.check_room(session)
                self._take_ground(session, Access.COMMAND)
                session.grounds.admit(connection, Access.COMMAND, None)
                session.announce(newcomer=connection)
        except HelloError as error:
            self._refuse_legacy(connection, error)
            return
        if silent:
            connection.owner = LegacyClientAdapter(connection.owner, self)

    def _refuse_legacy(self, connection: Connection, error: HelloError) -> None:
        """Close without a line: a legacy client would read it as a malformed message."""
        self._linger(connection, error)
        connection.fail(error.reason)

    def _linger(self, connection: Connection, error: HelloError) -> None:
        self.refused[error.code] += 1
        self._since_s.pop(connection, None)
        self._lingering.begin(connection, self._poller.now_s)


def check_name(connection: Connection, aircraft: str) -> None:
    """Raise HelloError if the certificate is of another aircraft, or of a ground."""
    if connection.peer_name not in ("", aircraft):
        raise HelloError(NAME, f"the certificate names {connection.peer_name}, not {aircraft}")


class LegacyClientAdapter(Owner):
    """Owns a connection that counts as a legacy client because it sent nothing.

    A hello that the network delayed past the time limit is still accepted if it is the first data
    of the connection.
    """

    def __init__(self, owner: Owner, handshake: Handshake) -> None:
        self._owner = owner
        self._handshake = handshake

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        if lines.startswith(PREFIX):
            self._owner.on_end(connection, "late hello")
            self._handshake.begin(connection)
        else:
            connection.owner = self._owner
        connection.owner.on_lines(connection, lines)

    def on_drained(self, connection: Connection) -> None:
        self._owner.on_drained(connection)

    def on_end(self, connection: Connection, reason: str) -> None:
        self._owner.on_end(connection, reason)


class LingeringClose(Owner):
    """Owns refused connections: discards their data for a while, then closes them."""

    def __init__(self) -> None:
        self._since_s: dict[Connection, float] = {}
        self._rx_bytes: dict[Connection, int] = {}

    def begin(self, connection: Connection, now_s: float) -> None:
        connection.owner = self
        connection.partial = None
        self._since_s[connection] = now_s
        self._rx_bytes[connection] = 0

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        self._discard(connection, len(lines))

    def on_partial_line(self, connection: Connection) -> None:
        partial, connection.partial = connection.partial, None
        self._discard(connection, len(partial or b""))

    def on_end(self, connection: Connection, reason: str) -> None:
        self._since_s.pop(connection, None)
        self._rx_bytes.pop(connection, None)

    def sweep(self, now_s: float) -> None:
        for connection, since_s in self._since_s.items():
            if now_s - since_s >= LINGER_S:
                connection.fail("refused")

    def _discard(self, connection: Connection, count: int) -> None:
        self._rx_bytes[connection] += count
        if self._rx_bytes[connection] > LINGER_BYTES:
            connection.fail("refused")
