"""The whole proxy on real sockets and a virtual clock."""

import socket
import time

from twisted.internet import task

from up_proxy.config import LimitsConfig, ProxyConfig, QuotaConfig, TLSConfig
from up_proxy.proxy import Proxy

DEADLINE_S = 20.0


class HandReactor(task.Clock):
    """A reactor whose time and events the test controls."""

    def __init__(self):
        super().__init__()
        self.readers = []
        self.rightNow = 1000.0

    def addReader(self, reader):  # noqa: N802
        self.readers.append(reader)

    def removeReader(self, reader):  # noqa: N802
        self.readers.remove(reader)


class Peer:
    """A client of the virtual proxy; `heard` is all its received data."""

    def __init__(self, bench, port, host=""):
        self.bench = bench
        self.socket = socket.create_connection(("127.0.0.1", port), source_address=(host, 0))
        # Without it the kernel holds a second small write back, and virtual time flies past it.
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.socket.setblocking(False)
        self.heard = b""
        self.closed = False
        bench.peers.append(self)

    def say(self, data):
        if isinstance(data, str):
            data = data.encode("ascii")
        self.bench.push(self, data)
        return self

    def read(self):
        while not self.closed:
            try:
                chunk = self.socket.recv(65536)
            except BlockingIOError:
                return
            except ConnectionError:
                chunk = b""
            if not chunk:
                self.closed = True
            self.heard += chunk

    def expect(self, data):
        """Wait until `data` was received, and discard everything up to its end."""
        if isinstance(data, str):
            data = data.encode("ascii")
        self.bench.until(lambda: data in self.heard, f"{data!r}, heard {self.heard[-300:]!r}")
        before, _, self.heard = self.heard.partition(data)
        return before

    def line(self):
        self.bench.until(lambda: b"\n" in self.heard, f"a line, heard {self.heard!r}")
        line, _, self.heard = self.heard.partition(b"\n")
        return line.decode("ascii") + "\n"

    def refusal(self):
        """Return the code of a refusal, which ends the connection."""
        line = self.line()
        self.expect_closed()
        return line.removeprefix("UP1 error code=").partition(" reason=")[0]

    def expect_closed(self):
        self.bench.until(lambda: self.closed, "the end of the connection")

    def close(self):
        self.socket.close()
        self.bench.peers.remove(self)
        self.bench.settle()


class Bench:
    """A proxy between two free ports; `pump` lets it work, `pass_time` moves its clock."""

    def __init__(self, i_accept_plain=False, tls=None, quota=None, **limits):
        self.reactor = HandReactor()
        self.peers = []
        config = ProxyConfig(
            airborne_port=0,
            ground_port=0,
            address="127.0.0.1",
            metrics=False,
            i_accept_plain=i_accept_plain,
            limits=LimitsConfig(**{"connections_hz": 100000, **limits}),
            tls=tls or TLSConfig(),
            quota=QuotaConfig(**(quota or {})),
        )
        self.proxy = Proxy(self.reactor, config)
        self.proxy._poller.busy_poll_s = 0.001
        self.proxy.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for peer in self.peers:
            peer.socket.close()
        self.proxy.stop()

    def pump(self):
        for reader in list(self.reactor.readers):
            reader.doRead()
        for peer in self.peers:
            peer.read()

    def settle(self):
        """Wait until the data sent on the loopback has arrived and had its effects."""
        for _ in range(5):
            self.pump()

    def until(self, condition, what):
        deadline_s = time.monotonic() + DEADLINE_S
        while not condition():
            assert time.monotonic() < deadline_s, f"never came: {what}"
            self.pump()

    def push(self, peer, data):
        deadline_s = time.monotonic() + DEADLINE_S
        view = memoryview(data)
        while view:
            assert time.monotonic() < deadline_s, "the proxy does not read"
            try:
                view = view[peer.socket.send(view) :]
            except BlockingIOError:
                self.pump()
        self.settle()

    def pass_time(self, seconds, heartbeats=()):
        """Move the clock; the peers named send their tick every second."""
        for _ in range(round(seconds * 4)):
            self.reactor.advance(0.25)
            self.pump()
            if self.reactor.rightNow % 1.0 < 0.25:
                for peer in heartbeats:
                    self.push(peer, b"\n")

    def air(self, first=""):
        peer = Peer(self, self.proxy.airborne_port)
        return peer.say(first) if first else peer

    def ground(self, first="", host=""):
        peer = Peer(self, self.proxy.ground_port, host)
        return peer.say(first) if first else peer

    def hello_air(self, name="a", extra=""):
        """Return an accepted aircraft and its token."""
        peer = self.air(f"UP1 aircraft={name}{extra}\n")
        return peer, token_of(peer.line(), name, "air")

    def hello_ground(self, name="a", asks="command", gets=None, extra=""):
        """Return an accepted ground and its token, the news that it gets at first forgotten."""
        peer = self.ground(f"UP1 aircraft={name} seat={asks}{extra}\n")
        token = token_of(peer.line(), name, gets or asks)
        peer.line()
        peer.number = peer.line()
        return peer, token

    def aircraft(self, name="a"):
        return next(each for each in self.proxy.registry.aircraft() if each.name == name)


def token_of(line, name, seat):
    start = f"UP1 ok aircraft={name} seat={seat} token="
    assert line.startswith(start), line
    token = line.removeprefix(start).removesuffix("\n")
    assert len(token) == 32
    int(token, 16)
    return token
