"""The far end of a socket: raw bytes, without the project's codec."""

# ruff: noqa: N802 - Twisted's names

import json

from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint, TCP4ServerEndpoint, TCP6ClientEndpoint
from twisted.internet.protocol import DatagramProtocol, Factory, Protocol, ServerFactory

from tests.support.reactor import until
from up.tls.protocol import TLSServerFactory


class Peer(Protocol):
    """One TCP connection: the received data, whether it is open."""

    def __init__(self):
        self.received = b""
        self.is_open = False
        self.closed = Deferred()

    def connectionMade(self):
        self.is_open = True
        self.transport.setTcpNoDelay(True)

    def dataReceived(self, data):
        self.received += data

    def connectionLost(self, reason):
        self.is_open = False
        self.closed.callback(None)

    def say(self, *messages):
        """Send raw bytes, or objects as JSON lines."""
        for message in messages:
            raw = message if isinstance(message, bytes) else json.dumps(message).encode() + b"\n"
            self.transport.write(raw)

    @property
    def lines(self):
        """The whole lines that came and are not empty."""
        return [line for line in self.received.split(b"\n")[:-1] if line]

    @property
    def messages(self):
        return [json.loads(line) for line in self.lines if line.startswith(b"{")]

    def named(self, name):
        return [message for message in self.messages if message["name"] == name]

    def answer_to(self, id_):
        """The up.ack or up.nack of an id, or None."""
        for message in self.messages:
            if message["name"] in ("up.ack", "up.nack") and message["data"]["id"] == id_:
                return message
        return None

    async def answer(self, id_):
        return await until(lambda: self.answer_to(id_), what=f"answer to {id_}")

    async def close(self):
        if self.is_open:
            self.transport.abortConnection()
            await self.closed


class Server:
    """Listens and keeps every connection that came."""

    def __init__(self, reactor):
        self.reactor = reactor
        self.peers = []
        self.port = None

    async def open(self, number=0):
        factory = Factory()
        factory.noisy = False
        factory.buildProtocol = lambda addr: self._new()
        endpoint = TCP4ServerEndpoint(self.reactor, number, interface="127.0.0.1")
        self.port = await endpoint.listen(factory)
        return self.port.getHost().port

    def _new(self):
        peer = Peer()
        self.peers.append(peer)
        return peer

    async def peer(self, index=0):
        await until(
            lambda: len(self.peers) > index and (self.peers[index].is_open),
            what=f"connection {index}",
        )
        return self.peers[index]

    async def close(self):
        await self.port.stopListening()
        for peer in self.peers:
            await peer.close()


class TLSServer(Server):
    """A server with TLS in front of Peer."""

    def __init__(self, reactor, files):
        super().__init__(reactor)
        self.files = files

    async def open(self, number=0):
        wrapped = ServerFactory()
        wrapped.noisy = False
        wrapped.buildProtocol = lambda addr: self._new()
        self.factory = TLSServerFactory(self.reactor, self.files, wrapped, clients=True)
        self.port = self.reactor.listenTCP(number, self.factory, interface="127.0.0.1")
        return self.port.getHost().port


async def connect(reactor, port, host="127.0.0.1"):
    """Connect a Peer."""
    factory = Factory.forProtocol(Peer)
    factory.noisy = False
    endpoint = TCP6ClientEndpoint if ":" in host else TCP4ClientEndpoint
    return await endpoint(reactor, host, port).connect(factory)


class UdpPeer(DatagramProtocol):
    """A UDP socket: the datagrams that came."""

    noisy = False

    def __init__(self, reactor, host="127.0.0.1"):
        self.datagrams = []
        self.port = reactor.listenUDP(0, self, interface=host)

    def datagramReceived(self, datagram, addr):
        self.datagrams.append(datagram)

    def say(self, message, port, host="127.0.0.1"):
        raw = message if isinstance(message, bytes) else json.dumps(message).encode() + b"\n"
        self.transport.write(raw, (host, port))

    @property
    def messages(self):
        return [json.loads(each) for each in self.datagrams]

    async def close(self):
        await self.port.stopListening()
