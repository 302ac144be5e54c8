"""A link between real UDP sockets: datagrams to it reach the target over the link."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from twisted.internet.protocol import DatagramProtocol

from up.system.clock import Clock, cancel
from up.system.udp import listen_udp
from up_simulator.link.model import LinkModel
from up_simulator.link.pipe import LinkPipe
from up_simulator.link.relay import LOOPBACK, ListeningRelay
from up_simulator.link.stream import POLL_S

HEADER = 28
"""Bytes of an IPv4 and a UDP header, which a link carries too."""
MAX_QUEUED = 256
"""Datagrams on their way at most, as a queue in the network has an end."""
MAX_CLIENTS = 64
MAX_DATAGRAM_BYTES = 65536
_TINY_S = 1e-9

Address = tuple[str, int]


class _Direction:
    """One direction: datagrams by the model, each handed over when it arrives."""

    def __init__(self, clock: Clock, model: LinkModel) -> None:
        self._clock = clock
        self._pipe: LinkPipe[tuple[Callable[[bytes], object], bytes]] = LinkPipe(
            model, is_datagram=True
        )
        self._timer: Any = None
        self.lost = 0

    def send(self, data: bytes, deliver: Callable[[bytes], object]) -> None:
        if len(self._pipe) >= MAX_QUEUED:
            self.lost += 1
            return
        self._pipe.send((deliver, data), len(data) + HEADER, self._clock.seconds())
        self._run()

    def stop(self) -> None:
        self._pipe.clear()
        self._cancel()

    @property
    def total_lost(self) -> int:
        return self.lost + self._pipe.lost

    def _run(self) -> None:
        self._cancel()
        for deliver, data in self._pipe.take(self._clock.seconds() + _TINY_S):
            deliver(data)
        if len(self._pipe):
            next_s = self._pipe.next_s()
            wait_s = POLL_S if next_s == math.inf else next_s - self._clock.seconds()
            self._timer = self._clock.callLater(max(0.0, wait_s), self._on_timer)

    def _on_timer(self) -> None:
        self._timer = None
        self._run()

    def _cancel(self) -> None:
        cancel(self._timer)
        self._timer = None


class _Socket(DatagramProtocol):
    """A socket that hands its datagrams on, with the sender's address."""

    def __init__(self, on_datagram: Callable[[bytes, Address], object]) -> None:
        self._on_datagram = on_datagram

    def datagramReceived(self, datagram: bytes, addr: Address) -> None:  # noqa: N802
        self._on_datagram(datagram, addr)

    def connectionRefused(self) -> None:  # noqa: N802
        # Neither end is notified of the link's losses.
        pass

    def write(self, data: bytes, address: Address) -> None:
        transport: Any = self.transport
        if transport is not None:
            transport.write(data, address)


class DatagramRelay(ListeningRelay):
    """Takes datagrams and carries them to the target, and its answers to_client to their senders.

    Each client has its own socket towards the target; beyond 64 the oldest client loses its.
    ``target_host`` is an address, not a name. Otherwise as ``LinkRelay``.
    """

    def __init__(
        self,
        reactor: Any,
        listen_port: int,
        target_host: str,
        target_port: int,
        up: LinkModel,
        down: LinkModel,
        *,
        clock: Clock | None = None,
    ) -> None:
        super().__init__(reactor, listen_port, (target_host, target_port))
        self._up = _Direction(clock if clock is not None else reactor, up)
        self._down = _Direction(clock if clock is not None else reactor, down)
        self._listening_socket = _Socket(self._on_client)
        self._clients: dict[Address, tuple[_Socket, Any]] = {}

    @property
    def lost(self) -> int:
        return self._up.total_lost + self._down.total_lost

    async def stop(self) -> None:
        self._up.stop()
        self._down.stop()
        listener, self._listener = self._listener, None
        ports = [port for _socket, port in self._clients.values()]
        self._clients.clear()
        # Close all of them before waiting for the first.
        for closed in [port.stopListening() for port in (listener, *ports) if port is not None]:
            await closed

    def _listen(self) -> Any:
        return self._open(self._listen_port, self._listening_socket)

    def _open(self, number: int, protocol: DatagramProtocol) -> Any:
        port = listen_udp(self._reactor, number, protocol, LOOPBACK)
        # Twisted would cut datagrams longer than 8 KiB.
        port.maxPacketSize = MAX_DATAGRAM_BYTES
        return port

    def _on_client(self, data: bytes, address: Address) -> None:
        # The sending socket is looked up on arrival: it may be closed by then.
        self._socket_of(address)
        self._up.send(data, lambda arrived: self._to_target(arrived, address))

    def _to_target(self, data: bytes, address: Address) -> None:
        client = self._clients.get(address)
        if client is not None:
            client[0].write(data, self._target)

    def _socket_of(self, address: Address) -> None:
        if address in self._clients:
            return
        while len(self._clients) >= MAX_CLIENTS:
            _socket, port = self._clients.pop(next(iter(self._clients)))
            port.stopListening()

        def to_client(data: bytes, sender: Address) -> None:
            if sender == self._target:
                self._down.send(
                    data, lambda arrived: self._listening_socket.write(arrived, address)
                )

        fresh = _Socket(to_client)
        port = self._open(0, fresh)
        self._clients[address] = (fresh, port)
