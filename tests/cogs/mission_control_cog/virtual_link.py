"""The real proxy, aircraft and ground links on one clock of the test; their sockets are real."""

# ruff: noqa: N802, N803, N815 - Twisted's names

import struct

from mission_control_cog.modules.mission_control_provider import MissionControlProvider
from twisted.internet.address import IPv4Address
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.error import ConnectionDone, ConnectionRefusedError
from twisted.python.failure import Failure

from tests.proxy.virtual import Bench, Peer
from tests.support.system import build_up
from tests.support.transport import Transport
from up.life_cycle import LifeCycle
from up_ground import ground_link
from up_ground.ground_link import GroundLink
from up_ground.settings import Seat, Settings
from up_ground.telemetry import Telemetry
from up_ground.token_store import TokenStore
from up_proxy.proxy import Proxy

STEP_S = 0.05


class Wire(Transport):
    """Carries the bytes of a protocol over a real socket; `lose_lines` lets some vanish."""

    def __init__(self, net, port, protocol):
        super().__init__("127.0.0.1", port)
        self.peer, self.protocol, self.lose_lines, self.bytes_out = Peer(net, port), protocol, 0, 0
        self.segments, self.is_over, self.is_dark = 0, False, False

    def write(self, data):
        self.bytes_out += len(data)
        self.segments += 1
        if not self.peer.closed and not self.is_dark:
            self.peer.socket.send(data)

    def loseConnection(self):
        self.peer.closed = True

    abortConnection = loseConnection

    def getsockopt(self, level, option, size):
        """Answer as TCP_INFO of a connection that acknowledges each segment."""
        segments = 2 * self.segments
        info = struct.pack("=128x QII 56x Q", 0, segments // 2, segments // 2, self.bytes_out)
        return info[:size]

    def pump(self):
        if self.is_over:
            return
        if self.producer is not None:
            self.producer.resumeProducing()
        *lines, rest = self.peer.heard.split(b"\n")
        self.peer.heard = rest
        for line in lines:
            if self.is_dark:
                continue
            if self.lose_lines and not line.startswith(b"UP1"):
                self.lose_lines -= 1
            else:
                self.protocol.dataReceived(line + b"\n")
        if self.peer.closed:
            self.is_over = True
            self.peer.socket.close()
            self.protocol.connectionLost(Failure(ConnectionDone()))


class Net(Bench):
    """A proxy that can be restarted, and a reactor that connects to it."""

    def __init__(self, monkeypatch):
        self.wires = []
        super().__init__()
        self.reactor.connectTCP = self._connect
        self._ports = (self.proxy.airborne_port, self.proxy.ground_port)
        monkeypatch.setattr(ground_link, "HostnameEndpoint", TCP4ClientEndpoint)

    @property
    def now_s(self):
        return self.reactor.seconds()

    def _connect(self, host, port, factory, timeout=30, bindAddress=None):
        try:
            protocol = factory.buildProtocol(IPv4Address("TCP", host, port))
            wire = Wire(self, port, protocol)
        except OSError:
            gone = Failure(ConnectionRefusedError())
            self.reactor.callLater(0, factory.clientConnectionFailed, None, gone)
            return
        self.wires.append(wire)
        protocol.makeConnection(wire)

    def pump(self):
        super().pump()
        for wire in self.wires:
            wire.pump()
        for wire in [wire for wire in self.wires if wire.is_over]:
            self.wires.remove(wire)
            self.peers.remove(wire.peer)

    def run(self, seconds):
        for _ in range(round(seconds / STEP_S)):
            self.reactor.advance(STEP_S)
            self.settle()

    def run_until(self, condition, limit_s):
        """Return how long it took, in the clock's seconds."""
        began_s = self.now_s
        while not condition():
            assert self.now_s - began_s < limit_s, "never came"
            self.run(STEP_S)
        return self.now_s - began_s

    def restart_proxy(self):
        self.proxy.stop()
        config = self.proxy._config
        airborne, ground = self._ports
        new = type(config)(
            airborne_port=airborne, ground_port=ground, address="127.0.0.1", metrics=False
        )
        self.proxy = Proxy(self.reactor, new)
        self.proxy._poller.busy_poll_s = 0.001
        self.proxy.start()


class Flying:
    """An aircraft with telemetry and its uplink; `modules` are further ones."""

    def __init__(self, net, folder, text="", modules=()):
        port = net.proxy.airborne_port
        config = f"remote_server: {{url: 127.0.0.1, port: {port}}}\naircraft: a\n{text}"
        self.up = build_up(
            (MissionControlProvider, *modules),
            net.reactor,
            folder,
            config={"mission_control.yml": config},
        )
        self.provider = self.up.get_module(MissionControlProvider)
        self.life = LifeCycle(self.up)
        self.net = net
        Deferred.fromCoroutine(self.life.start())
        net.run_until(lambda: self.provider.connected, 30)

    @property
    def wire(self):
        return self.provider._uplink._link.transport

    def stop(self):
        Deferred.fromCoroutine(self.life.stop())
        self.net.run(0.2)


class Ground:
    """A ground station's link; `frames` has the time and the message of each frame."""

    def __init__(self, net, folder):
        folder.mkdir(exist_ok=True)
        settings = Settings("127.0.0.1", net.proxy.ground_port, "a", Seat.LISTEN)
        self.net, self.frames, self.telemetry = net, [], Telemetry()
        self.link = GroundLink(net.reactor, settings, self, TokenStore(folder, settings))
        self.link.start()
        net.run_until(lambda: self.link.status.is_open, 5)

    def on_link(self):
        pass

    def on_message(self, message):
        if self.telemetry.update(message, self.net.now_s):
            self.frames.append((self.net.now_s, message))

    @property
    def wire(self):
        return self.link._connection.transport

    def stop(self):
        Deferred.fromCoroutine(self.link.stop())
        self.net.run(0.2)
