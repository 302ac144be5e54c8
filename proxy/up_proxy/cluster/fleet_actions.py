"""What `up-fleet` makes a node do: report, drain, disconnect an aircraft."""

import socket
from collections.abc import Callable, Collection
from typing import Any

import psutil

from up_cluster.membership import Action, usage_of
from up_proxy.cluster.session import ClusterSession
from up_proxy.tenant_quota import TenantQuota


class FleetActions:
    """`drain` closes the ports, and leaves every aircraft to the other nodes."""

    def __init__(
        self,
        reactor: Any,
        sessions: Collection[ClusterSession],
        drain: Callable[[], None],
        quota: TenantQuota,
    ) -> None:
        self._reactor = reactor
        self._sessions = sessions
        self._drain_node = drain
        self._quota = quota
        self.is_draining = False
        self.actions: dict[str, Action] = {
            "report": self._report,
            "drain": self._drain,
            "kick": self._kick,
        }

    def _homes(self) -> list[ClusterSession]:
        return [each for each in self._sessions if each.is_home]

    def _report(self, message: dict[str, Any]) -> dict[str, Any]:
        guests = [each for each in self._sessions if not each.is_home and each.own_grounds]
        return {
            "kind": "proxy",
            "host": socket.gethostname(),
            "is_draining": self.is_draining,
            "aircraft": [self._row(each) for each in self._homes()],
            "guests": [self._row(each) for each in guests],
            "usage": self._quota.used()._asdict(),
            "quota": self._quota.limits,
            **usage_of(psutil.Process()),
        }

    @staticmethod
    def _row(session: ClusterSession) -> dict[str, Any]:
        state = "online" if session.air_lease.owner is not None else "offline"
        return {
            "aircraft": session.name,
            "state": state if session.is_home else "guest",
            "grounds": session.own_grounds,
            "rx_bytes": session.air_bytes + session.ground_bytes,
        }

    def _drain(self, message: dict[str, Any]) -> dict[str, Any]:
        names = [each.name for each in self._homes()]
        if not self.is_draining:
            self.is_draining = True
            # Not in the callback of a connection that the poller is serving.
            self._reactor.callLater(0, self._drain_node)
        return {"leaving": names}

    def _kick(self, message: dict[str, Any]) -> dict[str, Any]:
        for each in self._homes():
            if each.name == message.get("aircraft"):
                self._reactor.callLater(0, each.kick)
                return {"stopping": each.name}
        return {"code": "unknown_aircraft"}
