"""The grounds of other nodes at the home of an aircraft, as those nodes list them."""

from collections.abc import Callable, Collection
from functools import partial

from up.protocols.proxy_lines import Access, ControlGranted, ControlLost
from up_proxy.cluster.home_ground_side import HomeGroundSide
from up_proxy.cluster.node_messages import GroundLine, GroundList
from up_proxy.cluster.remote_ground import RemoteGround
from up_proxy.connection import Connection

LIST_LIMIT_S = 3.0
"""The grounds of a node that sends no list for this long count as gone."""


class RemoteGrounds:
    """Adds them to the grounds of the home by `admit`, and removes them; `send` sends a line."""

    def __init__(
        self,
        grounds: HomeGroundSide,
        admit: Callable[[Connection, Access, str], None],
        send: Callable[[int, bytes], None],
    ) -> None:
        self._grounds = grounds
        self._admit = admit
        self._send = send
        self.by_key: dict[tuple[str, int], RemoteGround] = {}
        """By node and number."""
        self._listed_s: dict[str, float] = {}

    def __len__(self) -> int:
        return len(self.by_key)

    @property
    def nodes(self) -> Collection[str]:
        """The nodes that send lists."""
        return self._listed_s.keys()

    def numbers(self, *nodes: str) -> dict[str, list[int]]:
        """Return the grounds of each of the nodes; without nodes those of all."""
        found: dict[str, list[int]] = {}
        for node, number in self.by_key:
            if not nodes or node in nodes:
                found.setdefault(node, []).append(number)
        return found

    def clear(self) -> None:
        self.by_key.clear()
        self._listed_s.clear()

    def update(self, node: str, listed: GroundList, now_s: float) -> bool:
        """Follow a node's list; return whether it has a new ground."""
        self._listed_s[node] = now_s
        present = {each.number: each for each in listed.grounds}
        self._end(node, keep=present.keys())
        is_new = False
        for number, each in present.items():
            known = self.by_key.get((node, number))
            if known is not None:
                known.last_rx_s = max(known.last_rx_s, now_s - each.age_s)
                self._correct(known, each.access)
                continue
            is_new = True
            remote = RemoteGround(each, now_s, partial(self._send_line, node, number))
            self.by_key[node, number] = remote
            self._admit(remote, each.access, each.token)
        return is_new

    def expire(self, now_s: float) -> None:
        """Remove the grounds of nodes that no longer send lists."""
        for node, listed_s in list(self._listed_s.items()):
            if now_s - listed_s > LIST_LIMIT_S:
                del self._listed_s[node]
                self._end(node)

    def _correct(self, remote: RemoteGround, shown: Access) -> None:
        """Repeat what a ground was sent about its control, and did not get."""
        is_owner = remote is self._grounds.lease.owner
        if is_owner is (shown is Access.COMMAND) or remote is self._grounds.granting:
            return
        if remote.speaks_hello:
            line = ControlGranted(remote.token) if is_owner else ControlLost()
            remote.send(line.encode())

    def _send_line(self, node: str, number: int, line: bytes) -> None:
        self._send(number, GroundLine(node, line).encode())

    def _end(self, node: str, keep: Collection[int] = ()) -> None:
        gone = [key for key in self.by_key if key[0] == node and key[1] not in keep]
        for key in gone:
            self._grounds.on_end(self.by_key.pop(key), "its node does not list it")
