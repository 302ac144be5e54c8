"""Real sockets on either side of a relay, and a clock that the test moves."""

from twisted.internet.error import ConnectionDone
from twisted.internet.interfaces import IHalfCloseableProtocol
from twisted.internet.protocol import ClientFactory, DatagramProtocol, Factory, Protocol
from twisted.internet.task import Clock
from zope.interface import implementer

from tests.support.reactor import reactor, run_in_reactor, sleep, until
from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.link.relay import LinkRelay

TURNS = 12
"""Rounds of the reactor after which nothing is left on its way between two local sockets."""


async def turn(rounds=TURNS):
    """Make sockets do everything that is due."""
    for _ in range(rounds):
        await sleep(0)


@implementer(IHalfCloseableProtocol)
class Peer(Protocol):
    """One end of a connection, which keeps received data."""

    def __init__(self):
        self.data = bytearray()
        self.is_connected = self.is_finished = self.is_lost = self.was_aborted = False

    def connectionMade(self):  # noqa: N802
        self.is_connected = True

    def dataReceived(self, data):  # noqa: N802
        self.data += data

    def readConnectionLost(self):  # noqa: N802
        self.is_finished = True

    def writeConnectionLost(self):  # noqa: N802
        pass

    def connectionLost(self, reason):  # noqa: N802
        self.is_lost = True
        self.was_aborted = not reason.check(ConnectionDone)

    def send(self, data):
        self.transport.write(data)


class Bench:
    """A target, a relay in front of it, and clients."""

    def __init__(self, up=None, down=None, *, clock=None, **options):
        self.clock = Clock() if clock is None else clock
        self.up = LinkModel(up or LinkSettings(), 1)
        self.down = LinkModel(down or LinkSettings(), 2)
        self.options = options
        self.targets = []
        self.clients = []
        self.relay = None
        self.listener = None

    async def __aenter__(self):
        factory = Factory.forProtocol(Peer)
        factory.noisy = False
        factory.buildProtocol = lambda _address: self.targets.append(Peer()) or self.targets[-1]
        self.listener = reactor.listenTCP(0, factory, interface="127.0.0.1")
        self.relay = LinkRelay(
            reactor,
            0,
            "127.0.0.1",
            self.listener.getHost().port,
            self.up,
            self.down,
            **self.options,
        )
        self.relay.clock = self.clock
        self.relay.start()
        return self

    @property
    def waiting(self):
        ends = [end for each in self.relay.connections for end in (each.near, each.far)]
        return sum(end.outgoing.waiting for end in ends)

    async def __aexit__(self, *exception):
        await self.relay.stop()
        if self.listener.connected:
            await self.listener.stopListening()
        for each in [*self.clients, *self.targets]:
            if each.is_connected and not each.is_lost:
                each.transport.abortConnection()
        await until(lambda: all(each.is_lost for each in self.clients + self.targets))
        if isinstance(self.clock, Clock):
            assert self.clock.getDelayedCalls() == []

    async def client(self):
        """Connect; the system does so whatever the link does."""
        factory = ClientFactory()
        factory.noisy = False
        made = Peer()
        factory.buildProtocol = lambda _address: made
        reactor.connectTCP("127.0.0.1", self.relay.port, factory)
        await until(lambda: made.is_connected)
        self.clients.append(made)
        await turn()
        return made

    async def pair(self):
        """Return a client and its target's end, connected over the link."""
        before = len(self.targets)
        client = await self.client()
        await self.wait_for(lambda: len(self.targets) > before)
        await self.wait_for(lambda: not self.clock.getDelayedCalls())
        return client, self.targets[-1]

    async def wait_for(self, condition, most_s=1000.0):
        """Move time from one of the relay's timers to the next until something holds."""
        end_s = self.clock.seconds() + most_s
        while not condition():
            calls = [each.getTime() for each in self.clock.getDelayedCalls()]
            assert self.clock.seconds() < end_s, "it does not happen"
            self.clock.advance(max(0.0, min(calls) - self.clock.seconds()) if calls else 0.01)
            await turn(4)

    async def pass_s(self, seconds):
        """Let so much time pass, and everything that is due in it happen."""
        end_s = self.clock.seconds() + seconds
        await turn()
        while True:
            due = [each.getTime() for each in self.clock.getDelayedCalls()]
            due_s = min((each for each in due if each <= end_s), default=None)
            if due_s is None:
                break
            self.clock.advance(max(0.0, due_s - self.clock.seconds()))
            await turn(4)
        self.clock.advance(max(0.0, end_s - self.clock.seconds()))
        await turn()


class UdpPeer(DatagramProtocol):
    """A UDP socket that keeps received datagrams, with their senders."""

    def __init__(self):
        self.got = []

    def datagramReceived(self, datagram, addr):  # noqa: N802
        self.got.append((datagram, addr))


def flown(function, *arguments):
    return run_in_reactor(function, *arguments)
