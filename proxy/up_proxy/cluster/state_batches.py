"""What holds for many aircraft, repeated to each node in few messages."""

from collections import defaultdict
from collections.abc import Callable
from typing import TYPE_CHECKING

from up.system.clock import Clock
from up_proxy.cluster.node_messages import pack_batch

if TYPE_CHECKING:
    from up_proxy.cluster.session import ClusterSession

SIZE = 16
"""Lists or beacons in a message: about half a millisecond at the receiver."""


class StateBatches:
    """Collects sessions by node, and sends their states: when a message is full, or very soon."""

    def __init__(self, clock: Clock, send: Callable[[str, bytes], None]) -> None:
        self._clock = clock
        self._send = send
        self._waiting: defaultdict[str, list[ClusterSession]] = defaultdict(list)

    def add(self, node: str, session: "ClusterSession") -> None:
        """Send a node the state that a session has then."""
        if not self._waiting:
            self._clock.callLater(0, self._send_rest)
        waiting = self._waiting[node]
        waiting.append(session)
        if len(waiting) == SIZE:
            self._send_states(node, waiting)
            waiting.clear()

    def discard(self, session: "ClusterSession") -> None:
        """Send no state of a session that ends."""
        for waiting in self._waiting.values():
            if session in waiting:
                waiting.remove(session)

    def _send_rest(self) -> None:
        waiting = dict(self._waiting)
        self._waiting.clear()
        for node, sessions in waiting.items():
            if sessions:
                self._send_states(node, sessions)

    def _send_states(self, node: str, sessions: "list[ClusterSession]") -> None:
        self._send(node, pack_batch((each.name, *each.state_for(node)) for each in sessions))
