"""A ground of another node, at the home of its aircraft."""

from collections.abc import Callable

from up.protocols.proxy_lines import AircraftPresence, ControlOwner, parse_line
from up.system.token_bucket import TokenBucket
from up_proxy.cluster.node_messages import ListedGround
from up_proxy.connection import Connection, Owner


class RemoteGround(Connection):
    """Stands for a connection at another node, and has no socket.

    The aircraft's lines go out once for all grounds of the other nodes, the owner of control and
    the aircraft's presence with the beacon: neither is sent for each ground. A ground that is
    paused, because the aircraft is slow, loses its lines.
    """

    __slots__ = ("_send",)

    def __init__(self, listed: ListedGround, now_s: float, send: Callable[[bytes], object]) -> None:
        self._send = send
        self._queue = None
        self._tls = None
        self.owner = Owner()
        self.host = listed.host
        self.token = listed.token
        self.number = 0
        self.speaks_hello = bool(listed.token)
        self.reads_packed = listed.packed
        self.reads_attitude = listed.attitude
        self.last_rx_s = self.last_tx_s = now_s - listed.age_s
        self.requested_s = 0.0
        self.handshakes: TokenBucket | None = None
        self.paused_s: float | None = None
        self.failure: str | None = None

    def send(self, line: bytes) -> None:
        if not isinstance(parse_line(line), AircraftPresence | ControlOwner):
            self._send(line)

    def pause(self) -> None:
        self.paused_s = self.paused_s or self.last_rx_s

    def resume(self) -> None:
        self.paused_s = None

    def fail(self, reason: str) -> None:
        """Let its node end the connection, by a line that is the reason."""
        if self.failure is None:
            self.failure = reason
            self._send(reason.encode("ascii", "replace"))
