"""The grounds of an aircraft at its home: a change of control is written before it is granted."""

from typing import TYPE_CHECKING

from twisted.internet.defer import Deferred

from up.log import UpLogger
from up.protocols.proxy_lines import CLUSTER, Access, ControlRelease, GroundLine
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.lease import LeaseLostError
from up_proxy.cluster.remote_ground import RemoteGround
from up_proxy.connection import Connection
from up_proxy.ground_side import GroundSide
from up_proxy.poller import Poller

if TYPE_CHECKING:
    from up_proxy.cluster.session import ClusterSession

_log = UpLogger.get_logger("proxy")


class HomeGroundSide(GroundSide):
    """Answers a hello that requests free control with `listen`; the grant follows as a line."""

    __slots__ = ("_session", "granting")

    def __init__(self, session: "ClusterSession", poller: Poller) -> None:
        super().__init__(session, poller)
        self._session = session
        self.granting: Connection | None = None
        """The ground whose grant is being written; others wait until they request again."""

    def replace(self, connections: tuple[Connection, ...]) -> None:
        super().replace(connections)
        self.receivers = tuple(each for each in connections if not isinstance(each, RemoteGround))

    def admit(self, ground: Connection, access: Access | None, token: str | None) -> Access:
        if access is Access.COMMAND and (
            self.granting is not None
            or (self.lease.is_free(self._poller.now_s) and not self.lease.is_resumed_by(token))
        ):
            super().admit(ground, Access.LISTEN, None)
            self._grant(ground, notify=True)
            return Access.LISTEN
        return super().admit(ground, access, token)

    def _grant(self, ground: Connection, notify: bool = False) -> None:
        if self.granting is None:
            self.granting = ground
            Deferred.fromCoroutine(self._write_and_grant(ground, notify)).addErrback(
                lambda failure: _log.failure("a grant failed on a bug", failure, code="proxy_bug")
            )

    async def _write_and_grant(self, ground: Connection, notify: bool) -> None:
        try:
            async with self._session.changes:
                await self._session.write(control=ground.token or None)
                if ground in self.connections and ground.failure is None:
                    super()._grant(ground, notify)
                    self._session.announce()
        except (UnavailableError, RefusedError, LeaseLostError):
            self._session.refused(CLUSTER)
        finally:
            self.granting = None

    def _apply(self, connection: Connection, control: GroundLine) -> bool:
        if isinstance(control, ControlRelease) and self.granting is not None:
            return False
        return super()._apply(connection, control)
