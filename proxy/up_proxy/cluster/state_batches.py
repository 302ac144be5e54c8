"""What holds for many aircraft, repeated to each node in few messages."""

from collections import defaultdict
from collections.abc import Callable
from typing import TYPE_CHECKING

from up_proxy.cluster.node_messages import pack_batch
from up_proxy.poller import Poller

if TYPE_CHECKING:
    from up_proxy.cluster.session import ClusterSession

SIZE = 16
"""Lists or beacons in a message: half a millisecond at the receiver, between relayed lines."""


class StateBatches:
    """Collects sessions by node, and sends their states between relayed lines."""

    def __init__(self, poller: Poller, send: Callable[[str, bytes], None]) -> None:
        self._poller = poller
        self._send = send
        self._waiting: defaultdict[str, list[ClusterSession]] = defaultdict(list)

    def add(self, node: str, session: "ClusterSession") -> None:
        """Send a node the state that a session has then."""
        if not self._waiting:
            self._poller.do_later(self._send_next)
        self._waiting[node].append(session)

    def _send_next(self) -> None:
        node, sessions = self._waiting.popitem()
        if sessions[SIZE:]:
            self._waiting[node] = sessions[SIZE:]
        if self._waiting:
            self._poller.do_later(self._send_next)
        states = ((each.name, *each.state_for(node)) for each in sessions[:SIZE])
        self._send(node, pack_batch(states))
