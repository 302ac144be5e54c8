"""Aircraft and grounds that reconnect as the real ones do, and the violations that they see."""

import itertools
import time
from collections import Counter
from dataclasses import dataclass

from twisted.internet.protocol import ClientFactory
from twisted.protocols.basic import LineOnlyReceiver

from tests.support.reactor import reactor
from up.protocols.proxy_lines import (
    Accepted,
    Access,
    AircraftPresence,
    ControlGranted,
    ControlLost,
    ControlRelease,
    ControlRequest,
    Hello,
    Refused,
    parse_line,
)
from up.protocols.tcp_options import watch_peer
from up.system.backoff import Backoff
from up.system.clock import cancel

CONNECT_LIMIT_S = 5.0
"""As of the real clients, which also wait as long for the answer to a hello."""
USER_TIMEOUT_MS = 1500
_IDS = itertools.count(1)


@dataclass
class Faults:
    """What may not happen, counted."""

    misdirected: int = 0
    """Lines of another aircraft."""
    repeated: int = 0
    """Commands that came twice, and frames that came twice or after newer ones on a connection."""
    double_owners: int = 0
    """Commands of a ground at an aircraft that had obeyed another one since its grant."""


class Traffic:
    """All peers at the nodes; `stop` ends them. `period_s`: of frames and of Commands."""

    def __init__(self, nodes, period_s=0.1):
        self.nodes = nodes
        self.period_s = period_s
        self.faults = Faults()
        self.aircraft = []
        self.grounds = []
        self.owners = {}
        """Who controlled each aircraft, in order: a ground, and the number of its grant."""

    def pair(self, air_node, ground_node, name):
        return self.add_aircraft(air_node, name), self.add_ground(ground_node, name)

    def add_aircraft(self, node, name):
        self.aircraft.append(Aircraft(self, node, name))
        return self.aircraft[-1]

    def add_ground(self, node, name, access=Access.COMMAND):
        self.grounds.append(Ground(self, node, name, access))
        return self.grounds[-1]

    def stop(self):
        for peer in (*self.aircraft, *self.grounds):
            peer.stop()

    def unexecuted(self):
        """Return the Commands that a ground saw acknowledged and no aircraft executed."""
        executed = set().union(*(each.executed for each in self.aircraft))
        return set().union(*(each.acknowledged for each in self.grounds)) - executed


class Gaps:
    """The longest time between two lines since `reset`, the present one included."""

    def __init__(self):
        self.reset()

    def reset(self):
        self._last_s, self._longest_s, self.count = time.monotonic(), 0.0, 0

    def on_line(self):
        self._longest_s, self._last_s = self.longest_s, time.monotonic()
        self.count += 1

    @property
    def longest_s(self):
        return max(self._longest_s, time.monotonic() - self._last_s)


class Peer(ClientFactory):
    """One end: connects to its node, after a loss to the next one, with its token."""

    noisy = False
    access = None

    def __init__(self, traffic, node, name):
        self.traffic = traffic
        self.node = node
        self.name = name
        self.id = next(_IDS)
        self.token = ""
        self.is_open = False
        self.stays = False
        """Whether it connects to its node alone, and often."""
        self.connects = 0
        self.opened_s = 0.0
        self.refusals = Counter()
        self._backoff = Backoff()
        self._link = None
        self._is_stopped = False
        self._timer = None
        self._count = itertools.count(1)
        self._connect()

    def stop(self):
        self._is_stopped = True
        cancel(self._timer)
        if self._link is not None:
            self._link.transport.abortConnection()

    def _connect(self):
        program = self.traffic.nodes.programs[self.node]
        port = program.ground_port if self.access else program.airborne_port
        host = self.traffic.nodes.host(self.node)
        if port:
            reactor.connectTCP(host, port, self, CONNECT_LIMIT_S)
        else:
            self.clientConnectionFailed(None, None)

    def buildProtocol(self, _):  # noqa: N802 - Twisted's name
        if self._is_stopped:
            return None
        self._link = Link(self)
        return self._link

    def clientConnectionFailed(self, *_):  # noqa: N802 - Twisted's name
        self._link = None
        if self._is_stopped:
            return
        if self.stays:
            self._backoff.reset()
        else:
            self.node = (self.node + 1) % len(self.traffic.nodes.programs)
        self._timer = reactor.callLater(self._backoff.pause_s(), self._connect)

    def on_made(self, link):
        link.send(Hello(self.name, self.access, self.token, packed=True).encode())
        self._timer = reactor.callLater(CONNECT_LIMIT_S, link.transport.abortConnection)

    def on_line(self, line):
        said = parse_line(line) if line.startswith(b"UP1 ") else None
        if isinstance(said, Accepted):
            self.token = said.token
            self.is_open = True
            self.connects += 1
            self.opened_s = time.monotonic()
            self._backoff.reset()
            cancel(self._timer)
            self.on_open(said)
            self._timer = reactor.callLater(self.traffic.period_s, self._beat)
        elif isinstance(said, Refused):
            self.refusals[said.code] += 1
            if said.code == "token":
                self.token = ""
            self._link.transport.abortConnection()
        elif said is not None:
            self.on_control(said)
        elif line:
            self.on_data(line.split(b" "))

    def on_lost(self):
        self.is_open = False
        cancel(self._timer)
        self.clientConnectionFailed()

    def on_open(self, accepted):
        pass

    def on_control(self, said):
        pass

    def _beat(self):
        self._timer = reactor.callLater(self.traffic.period_s, self._beat)
        self.on_beat()

    def send(self, *words):
        self._link.send(b" ".join(str(word).encode() for word in words) + b"\n")


class Link(LineOnlyReceiver):
    delimiter = b"\n"

    def __init__(self, peer):
        self._peer = peer

    def connectionMade(self):  # noqa: N802 - Twisted's name
        watch_peer(self.transport, USER_TIMEOUT_MS)
        self._peer.on_made(self)

    def lineReceived(self, line):  # noqa: N802 - Twisted's name
        self._peer.on_line(line)

    def connectionLost(self, _):  # noqa: N802 - Twisted's name
        self._peer.on_lost()

    def send(self, line):
        self.transport.write(line)


class Aircraft(Peer):
    """Sends frames with their number and time; executes Commands and acknowledges each."""

    def __init__(self, traffic, node, name):
        self.executed = set()
        super().__init__(traffic, node, name)

    def on_beat(self):
        self.send("frame", self.name, self.id, next(self._count), f"{time.monotonic():.4f}")

    def on_data(self, words):
        _, name, ground, grant, number = words
        faults, command = self.traffic.faults, (ground, number)
        if name.decode() != self.name:
            faults.misdirected += 1
            return
        faults.repeated += command in self.executed
        self.executed.add(command)
        owners = self.traffic.owners.setdefault(self.name, [])
        if (ground, grant) not in owners[-1:]:
            faults.double_owners += (ground, grant) in owners
            owners.append((ground, grant))
        self.send("ack", self.name, ground.decode(), number.decode())


class Ground(Peer):
    """Sends Commands while it has control; `grants` counts how often control was granted."""

    def __init__(self, traffic, node, name, access=Access.COMMAND):
        self.access = access
        self.has_control = False
        self.grants = 0
        self.is_aircraft_online = False
        self.acknowledged = set()
        self.sent = 0
        self.oldest_s = 0.0
        """Age of the oldest frame that came."""
        self.frames, self.answers = Gaps(), Gaps()
        self.round_trips_s = []
        """From each Command to its acknowledgement."""
        self._sent_s = {}
        self._last = {}
        super().__init__(traffic, node, name)

    def on_open(self, accepted):
        # At another node the lines of the last 2 s may come again.
        self._last.clear()
        self._set_control(accepted.access is Access.COMMAND)

    def on_control(self, said):
        if isinstance(said, ControlGranted):
            self.token = said.token
            self._set_control(True)
        elif isinstance(said, ControlLost):
            self._set_control(False)
        elif isinstance(said, AircraftPresence):
            self.is_aircraft_online = said.is_online

    def request(self):
        """Request control; a free one is granted."""
        self._say(ControlRequest())

    def release(self):
        if self.has_control:
            self._say(ControlRelease())

    def _say(self, line):
        if self.is_open:
            self._link.send(line.encode())

    def _set_control(self, has_control):
        self.grants += has_control
        self.has_control = has_control

    def on_beat(self):
        if self.has_control:
            self.sent += 1
            self._sent_s[self.sent] = time.monotonic()
            self.send("command", self.name, self.id, self.grants, self.sent)

    def on_data(self, words):
        if words[0] == b"ack":
            _, name, ground, number = words
            if int(ground) == self.id:
                self.acknowledged.add((ground, number))
                self.answers.on_line()
                if (sent_s := self._sent_s.pop(int(number), None)) is not None:
                    self.round_trips_s.append(time.monotonic() - sent_s)
        else:
            _, name, sender, number, sent_s = words
            self._on_frame(sender, int(number), float(sent_s))
        self.traffic.faults.misdirected += name.decode() != self.name

    def _on_frame(self, sender, number, sent_s):
        last = self._last.get(sender, 0)
        self.traffic.faults.repeated += number <= last
        self._last[sender] = max(last, number)
        self.oldest_s = max(self.oldest_s, time.monotonic() - sent_s)
        self.frames.on_line()
