"""The least that relays through NATS: Twisted's reactor, PUB and MSG, and no check of anything.

`python -m bench.cluster_peer NATS_PORT` prints its two ports, of aircraft and of grounds. It has no
leases, no control, no age, no limit: what a relay costs on Twisted before it does its work.
"""

import json
import sys
from collections.abc import Callable
from typing import Any

from twisted.internet import reactor as default_reactor
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint, TCP4ServerEndpoint, connectProtocol
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.task import react

reactor: Any = default_reactor


class Nats(Protocol):
    """SUB, PUB and MSG; the server's other lines mean nothing here."""

    transport: Any

    def __init__(self) -> None:
        self._rest = b""
        self._heard: list[Callable[[bytes], None]] = []

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self.transport.setTcpNoDelay(True)
        self.transport.write(b'CONNECT {"verbose":false,"echo":false}\r\nPING\r\n')

    def subscribe(self, subject: bytes, hear: Callable[[bytes], None]) -> None:
        self.transport.write(b"SUB %b %d\r\n" % (subject, len(self._heard)))
        self._heard.append(hear)

    def publish(self, subject: bytes, data: bytes) -> None:
        self.transport.write(b"PUB %b %d\r\n%b\r\n" % (subject, len(data), data))

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        data = self._rest + data
        at = 0
        while (end := data.find(b"\r\n", at)) >= 0:
            if data.startswith(b"MSG ", at):
                _, _, sid, size = data[at:end].split(b" ")
                stop = end + 2 + int(size)
                if len(data) < stop + 2:
                    break
                self._heard[int(sid)](data[end + 2 : stop])
                at = stop + 2
            else:
                if data.startswith(b"PING", at):
                    self.transport.write(b"PONG\r\n")
                at = end + 2
        self._rest = data[at:]


class Client(Protocol):
    """An aircraft or a ground: a hello, then its lines to the other side."""

    transport: Any
    nats: Nats
    kinds = b"down", b"up"

    def __init__(self) -> None:
        self._subject = b""

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self.transport.setTcpNoDelay(True)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        if self._subject:
            self.nats.publish(self._subject, data)
            return
        name = data.split(b"aircraft=")[1].split()[0]
        sends, receives = (b"peer.%b.%b" % (name, kind) for kind in self.kinds)
        self._subject = sends
        self.nats.subscribe(receives, self.transport.write)
        self.transport.write(b"UP1 ok\n")


class Ground(Client):
    kinds = b"up", b"down"


async def serve(_: Any, port: str) -> None:
    Client.nats = await connectProtocol(TCP4ClientEndpoint(reactor, "127.0.0.1", int(port)), Nats())
    ports = []
    for side in (Client, Ground):
        endpoint = TCP4ServerEndpoint(reactor, 0, interface="127.0.0.1", backlog=1024)
        ports.append((await endpoint.listen(Factory.forProtocol(side))).getHost().port)
    print(json.dumps(ports), flush=True)
    await Deferred()


if __name__ == "__main__":
    react(serve, sys.argv[1:])
