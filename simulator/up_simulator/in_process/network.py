"""The network between the programs of one process."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from errno import EADDRINUSE
from os import strerror
from typing import Any

from twisted.internet.error import CannotListenError

from up_simulator.link.model import LinkModel
from up_simulator.link.pipe import LinkPipe

ADDRESS = "127.0.0.1"
MIN_FREE_PORT = 49152
MAX_PORT = 65535

Delivery = tuple[Callable[..., object], tuple[Any, ...]]
Pipe = LinkPipe[Delivery]


class Route:
    """One direction between two ports: over a link, or without one, loss or delay."""

    def __init__(self, network: Network, pipe: Pipe | None) -> None:
        self._network = network
        self.pipe = pipe

    def carry(self, size: int, call: Callable[..., object], *arguments: Any) -> None:
        if self.pipe is None:
            self._network.next_step.append((call, arguments))
        else:
            self.pipe.send((call, arguments), size, self._network.clock.seconds())


class Network:
    """Holds the listeners, and delivers every packet at its time."""

    def __init__(self, clock: Any) -> None:
        self.clock = clock
        self.next_step: deque[Delivery] = deque()
        self.tcp: dict[int, Any] = {}
        self.udp: dict[int, Any] = {}
        self.to_write: dict[Any, None] = {}
        self._pipes: list[Pipe] = []
        self._models: list[tuple[LinkModel, Pipe, Pipe]] = []
        self._links: dict[int, tuple[LinkModel, LinkModel]] = {}
        self._next_port = MIN_FREE_PORT

    def link(self, port: int, up: LinkModel, down: LinkModel) -> None:
        """Route data to a port through ``up``, data from it through ``down``."""
        self._links[port] = (up, down)

    def routes(self, port: int, *, is_datagram: bool = False) -> tuple[Route, Route]:
        """Return the way to a port and the way back."""
        models = self._links.get(port)
        if models is None:
            return Route(self, None), Route(self, None)
        up, down = (self._pipe(model, is_datagram) for model in models)
        return Route(self, up), Route(self, down)

    def datagram_route(self, source: int, target: int) -> Route:
        """Return the way of a datagram, which passes the link of either port."""
        if target in self._links:
            return self.routes(target, is_datagram=True)[0]
        return self.routes(source, is_datagram=True)[1]

    def bind(self, table: dict[int, Any], port: int, who: Any, interface: str) -> int:
        """Bind a port, 0 for any free one; raises CannotListenError."""
        if port and port in table:
            error = OSError(EADDRINUSE, strerror(EADDRINUSE))
            raise CannotListenError(interface, port, error)
        bound = port or self.free_port()
        table[bound] = who
        return bound

    def free_port(self) -> int:
        """Return a port that neither TCP nor UDP uses; they are given out in order."""
        while True:
            port = self._next_port
            self._next_port = MIN_FREE_PORT if port == MAX_PORT else port + 1
            if port not in self.tcp and port not in self.udp:
                return port

    def move(self, now_s: float) -> None:
        """Deliver the data that has arrived, then send the written data."""
        for _ in range(len(self.next_step)):
            call, arguments = self.next_step.popleft()
            call(*arguments)
        for pipe in self._pipes:
            if pipe.waiting:
                for call, arguments in pipe.take(now_s):
                    call(*arguments)
        if self.to_write:
            writers, self.to_write = self.to_write, {}
            for writer in writers:
                writer.flush()

    def _pipe(self, model: LinkModel, is_datagram: bool) -> Pipe:
        for known, stream, datagrams in self._models:
            if known is model:
                return datagrams if is_datagram else stream
        stream, datagrams = Pipe(model), Pipe(model, is_datagram=True)
        self._models.append((model, stream, datagrams))
        self._pipes += [stream, datagrams]
        return datagrams if is_datagram else stream
