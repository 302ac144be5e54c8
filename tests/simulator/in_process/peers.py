"""Two programs on a simulated network, each with a protocol that writes down what happens."""

from twisted.internet.protocol import ClientFactory, DatagramProtocol, Factory, Protocol

from up_simulator.in_process.reactor import SimulatedReactor
from up_simulator.link.model import LinkModel

PORT = 3000


class Recorder(Protocol):
    def __init__(self, seconds):
        self.seconds = seconds
        self.received = b""
        self.arrivals_s = []
        self.lost = None
        self.lost_s = None

    def dataReceived(self, data):  # noqa: N802
        self.received += data
        self.arrivals_s.append(self.seconds())

    def connectionLost(self, reason):  # noqa: N802
        self.lost = reason.type.__name__
        self.lost_s = self.seconds()


class Server(Factory):
    noisy = False

    def __init__(self, build):
        self.build, self.peers, self.built = build, [], []

    def buildProtocol(self, addr):  # noqa: N802
        self.peers.append(addr)
        protocol = self.build()
        self.built.append(protocol)
        return protocol


class Client(ClientFactory):
    noisy = False

    def __init__(self, build):
        self.build, self.built, self.failed, self.lost = build, [], None, None

    def buildProtocol(self, addr):  # noqa: N802
        self.built.append(self.build())
        return self.built[-1]

    def clientConnectionFailed(self, connector, reason):  # noqa: N802
        self.failed = reason.type.__name__

    def clientConnectionLost(self, connector, reason):  # noqa: N802
        self.lost = reason.type.__name__


class Datagrams(DatagramProtocol):
    def __init__(self, seconds):
        self.seconds, self.received = seconds, []

    def datagramReceived(self, datagram, addr):  # noqa: N802
        self.received.append((datagram, addr, self.seconds()))


class Bench:
    """``here`` connects to ``there``; with settings the connection passes a link."""

    def __init__(self, up=None, down=None, *, seed=1, here=None, there=None):
        self.reactor = SimulatedReactor()
        self.pi, self.phone = self.reactor.host(), self.reactor.host()
        if up is not None:
            self.up, self.down = LinkModel(up, seed), LinkModel(down or up, seed + 1)
            self.reactor.link(PORT, self.up, self.down)
        self.server = Server(there or self.recorder)
        self.client = Client(here or self.recorder)
        self.port = self.pi.listenTCP(PORT, self.server)

    def recorder(self):
        return Recorder(self.reactor.seconds)

    def connect(self, port=PORT, wait_s=2.0, **options):
        connector = self.phone.connectTCP("127.0.0.1", port, self.client, **options)
        self.reactor.advance(wait_s)
        return connector

    @property
    def here(self):
        return self.client.built[-1]

    @property
    def there(self):
        return self.server.built[-1]

    def black_out(self):
        self.up.black_out()
        self.down.black_out()

    def restore(self):
        self.up.restore()
        self.down.restore()
