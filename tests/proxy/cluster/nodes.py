"""Three proxies as one cluster, each with its own NATS server first in its list."""

import select
import signal
import socket
import threading
import time
from collections import deque
from contextlib import ExitStack, contextmanager, suppress

from tests.proxy.program import Client, Program, accepted
from tests.support.scrape import scrape
from tests.support.waiting import DEADLINE_S, until
from up_cluster import nats_protocol as nats
from up_proxy.cluster.node_messages import ENVELOPE
from up_proxy.cluster.sender_ages import SETTLE_S

READY_S = 60.0


class Nodes:
    """The running proxies: `aircraft` and `ground` connect to one of them.

    Each runs where its NATS server does: `hosts` of `tests.support.hosts`, or this one.
    """

    def __init__(self, servers, folder, count=3, more=""):
        self.servers = servers
        self.folder = folder
        self.more = more
        self._stack = ExitStack()
        self.programs = [self._program(number) for number in range(count)]

    def _program(self, number):
        urls = self.servers.urls.split(",")
        urls = ",".join([*urls[number:], *urls[:number]])
        text = f"cluster:\n  servers: {urls}\n{self.more}"
        prefix = self.servers.prefixes[number % len(self.servers.prefixes)]
        program = Program(self.folder / f"proxy{number}", text, prefix=prefix)
        self._stack.push(program)
        return program

    def __enter__(self):
        try:
            until(lambda: all(map(self.is_ready, self.programs)), "the cluster", READY_S)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for program in self.programs:
            if program.process.poll() is None:
                program.process.send_signal(signal.SIGCONT)
        self._stack.close()

    @staticmethod
    def is_ready(program):
        return "cluster_ready" in program.codes()

    def start(self, number):
        """Begin to start a proxy again, at new ports."""
        self.programs[number] = self._program(number)

    def restart(self, number):
        """Start a proxy again, and wait until it serves."""
        self.start(number)
        until(lambda: self.is_ready(self.programs[number]), "the node", READY_S)

    def host(self, node):
        return self.servers.hosts[node % len(self.servers.hosts)]

    def aircraft(self, node, name, token=""):
        words = f" token={token}" * bool(token)
        hello = f"UP1 aircraft={name} packed=1{words}\n"
        return accepted(self.programs[node].airborne_port, hello, self.host(node))

    def ground(self, node, name, access="command", token=""):
        words = f" token={token}" * bool(token)
        hello = f"UP1 aircraft={name} seat={access} packed=1{words}\n"
        return accepted(self.programs[node].ground_port, hello, self.host(node))

    def pair(self, air_node, ground_node, name):
        """Return an aircraft, the ground in control of it, and both tokens."""
        aircraft, air_token = self.aircraft(air_node, name)
        ground, token = self.ground(ground_node, name)
        ground.expect("seat command")
        return aircraft, ground, air_token, token

    def figure(self, node, name):
        return scrape(self.programs[node].metrics_port)[(f"up_proxy_cluster_{name}",)]

    def connections(self, node):
        """Return how many aircraft are connected, or wait for the answer to their hello."""
        return scrape(self.programs[node].metrics_port)[("up_proxy_connections", "airborne")]

    def introduce(self, node, nats, sender):
        """Let a node measure the age of the messages of another one, made by `packed`."""
        known = self.figure(node, "nodes")
        nats.publish("up.default.nodes", packed(sender, 0, 0, b""))
        until(lambda: self.figure(node, "nodes") > known, "the new sender")
        time.sleep(SETTLE_S)

    def control_refused(self, node):
        """Return how many changes of control were refused for want of the cluster."""
        page = scrape(self.programs[node].metrics_port)
        return page.get(("up_proxy_cluster_refused_total", "cluster"), 0)


def relayed(aircraft, ground, mark):
    """Check that a line of each reaches the other."""
    aircraft.say(f'{{"down": "{mark}"}}\n')
    ground.expect(f'"down": "{mark}"')
    ground.say(f'{{"up": "{mark}"}}\n')
    aircraft.expect(f'"up": "{mark}"')


def burst(pairs, count=300):
    """Check that many numbered lines of many pairs arrive whole and in order, sent all at once."""
    lines = [f'{{"n": {n}, "rest": "{"x" * (n % 200)}"}}\n' for n in range(count)]
    for aircraft, ground, *_ in pairs:
        for line in lines:
            aircraft.say(line)
            ground.say(line)
    for aircraft, ground, *_ in pairs:
        for end in (aircraft, ground):
            assert [end.expect('"n": ') for _ in lines] == lines


@contextmanager
def alive(*clients):
    """Send heartbeats of each client, which else is away after 3 s, and close it at the end."""
    ended = threading.Event()

    def tick():
        while not ended.wait(0.5):
            for client in clients:
                with suppress(OSError):
                    client.say("\n")

    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        for client in clients:
            client.close()


def refusal(port, hello):
    with Client(port, hello) as client:
        line = client.line()
        assert line.startswith("UP1 error code="), line
        return line.split("code=")[1].split(" ")[0]


def heard_until(client, mark):
    """Return the lines up to the one that contains `mark`."""
    lines = ""
    while mark not in lines:
        line = client.line()
        assert line, f"closed before {mark!r} came"
        lines += line
    return lines


def is_closed_after(client, line):
    """Return whether the proxy has closed the connection; what it sent is discarded."""
    try:
        client.say(line)
        readable, _, _ = select.select([client.socket], [], [], 0.1)
        return bool(readable) and client.socket.recv(65536) == b""
    except ConnectionError:
        return True


def packed(sender, fence, ground, body, age_s=0.0):
    """Return a message of a node whose clock is this machine's."""
    sent_ms = int((time.monotonic() - age_s) * 1000)
    return ENVELOPE % (sender.encode(), fence, sent_ms, ground, body)


class RawNats:
    """A connection to a NATS server, for messages that a proxy does not send."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S)
        self.file = self.socket.makefile("rb")
        self.messages = deque()

    def __enter__(self):
        assert self.file.readline().startswith(b"INFO ")
        self.socket.sendall(nats.connect({"verbose": False, "headers": True}))
        return self

    def __exit__(self, *_):
        self.file.close()
        self.socket.close()

    def publish(self, subject, payload):
        """Publish, and wait until the server has taken it."""
        self.socket.sendall(nats.publish(subject, payload) + nats.PING)
        while self._event() is not nats.Pong:
            pass

    def store(self, subject, payload):
        """Publish to a stream, and wait until it is stored."""
        self.subscribe("_INBOX.stored")
        self.socket.sendall(nats.publish(subject, payload, reply="_INBOX.stored"))
        assert b'"seq"' in self.message().payload

    def subscribe(self, subject):
        self.socket.sendall(nats.subscribe(subject, 1))

    def message(self):
        while not self.messages:
            self._event()
        return self.messages.popleft()

    def _event(self):
        """Read one event, keep a message, and return the kind of another one."""
        events = []
        parser = nats.NatsParser(events.append)
        while not events:
            parser.feed(self.file.readline())
        (event,) = events
        if isinstance(event, nats.Message):
            self.messages.append(event)
        elif isinstance(event, nats.Ping):
            self.socket.sendall(nats.PONG)
        return type(event)
