"""The handshake at a node of a cluster: the aircraft's lease comes before the answer."""

from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import Any

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from up.log import UpLogger
from up.protocols.proxy_lines import CLUSTER, FULL, Accepted, Access, Hello, HelloError, Side
from up_cluster.errors import RefusedError, UnavailableError
from up_proxy.aircraft import AircraftSession
from up_proxy.cluster.session import ClusterSession
from up_proxy.connection import Connection, Owner
from up_proxy.handshake import LEGACY_AIRCRAFT, Handshake, check_name, new_token

_log = UpLogger.get_logger("proxy")


class ClusterHandshake(Handshake):
    """Claims an aircraft's lease before it is admitted; a ground without a home is a guest."""

    def _admit(self, connection: Connection, hello: Hello) -> None:
        session = self._session(hello.aircraft)
        if self._side is Side.AIRBORNE:
            check_name(connection, hello.aircraft)

            def admit(token: str) -> None:
                super(ClusterHandshake, self)._admit(connection, replace(hello, token=token))

            self._wait(connection, session.claim(connection, hello.token), admit, self._refuse)
        elif session.is_home:
            super()._admit(connection, hello)
        else:
            self._check_guests(session)
            try:
                self._take_ground(session, hello.access)
            except HelloError as error:

                def admit_resumed(_: str) -> None:
                    if session.is_home:
                        super(ClusterHandshake, self)._admit(connection, hello)
                    else:
                        self._admit_guest(session, connection, hello)

                requests = hello.access is not Access.LISTEN
                checked = session.check_control(hello.token, error, requests=requests)
                self._wait(connection, checked, admit_resumed, self._refuse)
            else:
                self._admit_guest(session, connection, hello)

    def _admit_guest(self, session: ClusterSession, connection: Connection, hello: Hello) -> None:
        connection.speaks_hello = True
        connection.reads_packed = hello.packed
        connection.reads_attitude = hello.attitude
        connection.token = hello.token or new_token()
        access = hello.access or Access.COMMAND
        connection.send(Accepted(hello.aircraft, Access.LISTEN, connection.token).encode())
        session.guests.admit(connection, access)
        session.guests.greet(connection)
        session.send_list()

    def _take_aircraft(self, session: AircraftSession) -> None:
        """Do nothing: its claim counted it."""

    def _admit_legacy(self, connection: Connection, silent: bool) -> None:
        try:
            session = self._session(LEGACY_AIRCRAFT)
            if self._side is Side.AIRBORNE:
                check_name(connection, LEGACY_AIRCRAFT)

                def admit(_: str) -> None:
                    session.air_lease.release()
                    super(ClusterHandshake, self)._admit_legacy(connection, silent)

                self._wait(connection, session.claim(connection, None), admit, self._refuse_legacy)
                return
            if not session.is_home:
                self._check_guests(session)
                self._take_ground(session, Access.COMMAND)
                session.guests.admit(connection, Access.COMMAND)
                session.send_list()
                return
        except HelloError as error:
            self._refuse_legacy(connection, error)
            return
        super()._admit_legacy(connection, silent)

    def _session(self, name: str) -> ClusterSession:
        session = self._registry.session(name)
        assert isinstance(session, ClusterSession)
        return session

    def _check_guests(self, session: ClusterSession) -> None:
        if len(session.guests.connections) > self._registry.limits.listeners:
            raise HelloError(FULL, "too many grounds for this aircraft")

    def _wait(
        self,
        connection: Connection,
        claim: Coroutine[Any, Any, str],
        admit: Callable[[str], None],
        refuse: Callable[[Connection, HelloError], None],
    ) -> None:
        """Hold the connection until its claim has a token, then admit or refuse it."""
        waiting = connection.owner = WaitingClient()
        connection.pause()

        async def wait() -> None:
            error = None
            try:
                claimed = await claim
                if connection.failure is None:
                    admit(claimed)
            except HelloError as refusal:
                error = refusal
            except (UnavailableError, RefusedError):
                error = HelloError(CLUSTER, "no lease: the cluster does not answer")
            if connection.failure is None:
                connection.resume()
                if error is not None:
                    refuse(connection, error)
                elif waiting.lines:
                    connection.owner.on_lines(connection, waiting.lines)

        Deferred.fromCoroutine(wait()).addErrback(self._on_bug, connection)

    def _on_bug(self, failure: Failure, connection: Connection) -> None:
        _log.failure("a claim failed on a bug", failure, code="proxy_bug")
        connection.fail("internal error")


class WaitingClient(Owner):
    """Keeps the lines behind a hello in its segment; the connection is paused."""

    def __init__(self) -> None:
        self.lines = b""

    def on_lines(self, connection: Connection, lines: bytes) -> None:
        self.lines += lines
