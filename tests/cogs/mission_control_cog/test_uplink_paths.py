"""Failover between two interfaces: real proxy, real aircraft, real ground with a key."""

import errno
import socket
import struct
from types import SimpleNamespace

import pytest
from mission_control_cog import uplink_paths
from mission_control_cog.config import MISSION_CONTROL
from mission_control_cog.uplink import Uplink
from mission_control_cog.uplink_paths import CHECK_S, SILENCE_S, OnInterface, UplinkPaths
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.error import ConnectError
from twisted.internet.protocol import Factory, Protocol
from twisted.internet.testing import MemoryReactorClock
from twisted.logger import globalLogPublisher

from tests.cogs.mission_control_cog.hostile_relay import Ground, pair
from tests.cogs.mission_control_cog.system import Aircraft
from tests.cogs.mission_control_cog.test_uplink import OK, accepted
from tests.cogs.mission_control_cog.two_paths import two_paths
from tests.cogs.peers import Server
from tests.proxy.namespace import must
from tests.proxy.program import Program
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.telemetry_commands import TelemetryFrequencyCommand
from up.config import ConfigErrors
from up.protocols.general_message import encode
from up_ground.settings import Seat
from up_simulator.harness.two_paths import BEST, PROXY, PROXY_FOR_GROUND, SPARE


class Connection:
    """A transport whose kernel has `waiting` unacknowledged segments since `silent_s`."""

    def __init__(self, clock):
        self.clock, self.silent_s, self.waiting, self.trip_s = clock, 0.0, 1, 0.02

    def getHandle(self):  # noqa: N802
        return self

    def getsockopt(self, level, option, size):
        age_ms = round((self.clock.seconds() - self.silent_s) * 1e3)
        trip_us = round(self.trip_s * 1e6)
        return struct.pack("=24x I 28x I 8x I", self.waiting, age_ms, trip_us)


class Paths:
    """Two paths on a fake clock, the link on the first; `left` has the codes and times."""

    def __init__(self):
        self.clock, self.left, self.attempts = MemoryReactorClock(), [], []
        self.clock.connectTCP = self._connect
        self.bound = []
        self.paths = UplinkPaths(self.clock, ("best", "spare"), 10.0, self._leave)
        self.paths.start()
        self.paths.next("127.0.0.1", 1)
        self.connection = Connection(self.clock)
        self.paths.made(self.connection)

    def _leave(self, code, reason):
        self.left.append((code, round(self.clock.seconds(), 3)))

    def _connect(self, host, port, factory, *args, **kwargs):
        self.attempts.append(factory)
        handle = SimpleNamespace(setsockopt=lambda *option: self.bound.append(option))
        return SimpleNamespace(transport=SimpleNamespace(getHandle=lambda: handle))

    def answer_probes(self):
        for factory in self.attempts:
            made = factory.buildProtocol(None)
            made.makeConnection(SimpleNamespace(abortConnection=lambda: None))
        self.attempts.clear()

    def run(self, seconds, is_heard=True):
        for _ in range(round(seconds / CHECK_S)):
            if is_heard:
                self.connection.silent_s = self.clock.seconds() + CHECK_S
            self.clock.advance(CHECK_S)
            self.answer_probes()


def test_a_silent_path_is_left_within_a_second_for_one_that_answers():
    it = Paths()
    it.run(6)
    it.run(2, is_heard=False)
    ((code, left_s),) = it.left
    assert code == "path_silent"
    assert SILENCE_S <= round(left_s - 6, 3) <= SILENCE_S + 2 * CHECK_S
    assert it.bound == [(socket.SOL_SOCKET, socket.SO_BINDTODEVICE, b"spare")]


def test_no_path_is_left_without_a_healthy_other_one_or_bytes_that_wait():
    it = Paths()
    it.answer_probes = it.attempts.clear
    it.run(6)
    it.run(2, is_heard=False)
    assert it.left == []
    it = Paths()
    it.run(6)
    it.connection.waiting = 0
    it.run(2, is_heard=False)
    assert it.left == []


def test_a_slow_path_and_a_program_that_slept_are_not_silence():
    it = Paths()
    it.run(6)
    it.connection.trip_s = 0.6
    it.run(1.5, is_heard=False)
    it.connection.trip_s = 0.02
    it.run(1)
    it.clock.advance(5)
    it.run(0.5, is_heard=False)
    assert it.left == []


async def test_a_refused_attempt_keeps_the_link_and_a_lost_link_keeps_the_attempt():
    ready, lost = [], []
    server = Server(reactor)
    port = await server.open()
    uplink = Uplink(
        reactor, "127.0.0.1", port, "x", interfaces=("lo", "lo"), return_after_s=10.0,
        on_message=print, on_malformed=print, on_ready=ready.append,
        on_lost=lambda: lost.append(1),
    )  # fmt: skip
    uplink.start()
    first = await accepted(server)
    await until(lambda: ready)
    uplink._paths.leave("path_silent", "")
    refused = await server.peer(1)
    await until(lambda: refused.received)
    refused.say(b'UP1 error code=token reason="no"\n')
    await refused.closed
    assert uplink.is_ready
    uplink._paths.leave("path_silent", "")
    second = await server.peer(2)
    await until(lambda: b"token=" in second.received)
    first.transport.abortConnection()
    await until(lambda: lost)
    assert not uplink.is_ready
    second.say(OK)
    await until(lambda: len(ready) == 2)
    uplink._paths.leave("better_path", "")
    third = await accepted(server, 3)
    await second.closed
    assert (len(ready), len(lost), uplink.is_ready, third.is_open) == (3, 1, True, True)
    await uplink.stop()
    await server.close()


async def test_an_interface_that_is_absent_fails_the_attempt_with_its_name():
    endpoint = TCP4ClientEndpoint(OnInterface(reactor, "absent0"), "127.0.0.1", 9)
    with pytest.raises(ConnectError) as failed:
        await endpoint.connect(Factory.forProtocol(Protocol))
    assert (failed.value.osError, failed.value.code) == (errno.ENODEV, "interface_missing")
    assert "absent0" in str(failed.value)


@pytest.mark.parametrize(
    "text",
    [
        "remote_server: {interfaces: [wlan0, wlan0]}",
        "remote_server: {interfaces: ['wlan0; reboot']}",
        "remote_server: {interfaces: [an_interface_name]}",
        "remote_server: {interfaces: [wlan0]}\nhello: false",
    ],
)
def test_bad_interfaces_are_refused(tmp_path, text):
    (tmp_path / "mission_control.yml").write_text(text)
    with pytest.raises(ConfigErrors):
        MISSION_CONTROL.load(tmp_path)


def test_the_link_moves_and_returns_and_the_ground_keeps_control_and_session(tmp_path, monkeypatch):
    monkeypatch.setattr(uplink_paths, "PROBE_S", 0.5)
    pairing = pair(tmp_path / "a")
    text = (
        f"remote_server: {{url: {PROXY}, port: %d, security: require, interfaces: [{BEST}, {SPARE}]"
        ", return_after_s: 1}\n"
    )
    left, states = [], []

    def log(event):
        if event.get("code") in ("path_silent", "better_path", "link_lost"):
            left.append(event["code"])

    async def fly(paths, proxy):
        async with Aircraft(tmp_path / "a", None, text % proxy.airborne_port) as a:
            ground = Ground(tmp_path, proxy.ground_port, pairing, host=PROXY_FOR_GROUND)
            await ground.ready()
            status = ground.status
            ground.on_link = lambda: states.append((status.is_aircraft_online, status.seat))
            sessions = list(a.provider.protection.sessions._sessions)
            selector = a.provider._uplink._paths._selector

            async def moved(to):
                """Wait for the path, for telemetry on it, and for the answer to a Command."""
                await until(lambda: a.provider.telemetry_content["uplink"]["path"] == to, 10)
                beacon = a.up.beacons._next
                await until(lambda: ground.telemetry.beacon >= beacon)
                id_ = f"{to} {beacon}"
                assert ground.send("up.telemetry.frequency", {"frequency": 100}, id_)
                await until(lambda: ground.answers(id_))
                assert ground.answers(id_)[0].name == "up.ack"

            async def spare_is_healthy():
                await until(lambda: selector.has_other(selector.current, reactor.seconds()))

            await moved(BEST)
            await spare_is_healthy()
            paths.cut()
            await moved(SPARE)
            paths.restore()
            await moved(BEST)
            await spare_is_healthy()
            must("ip", "link", "set", BEST, "down")
            await moved(SPARE)
            # The other path grants no more than the first.
            a.listen_to(TelemetryFrequencyCommand)
            ground.link._send(encode("up.telemetry.frequency", {"frequency": 50}, "plain"))
            await until(lambda: a.up.command_receiver.counters["unprotected"] or a.heard)
            assert a.heard == []
            assert list(a.provider.protection.sessions._sessions) == sessions
            assert status.connections == 1
            assert set(states) <= {(True, Seat.COMMAND)}
            await ground.link.stop()

    globalLogPublisher.addObserver(log)
    try:
        with two_paths() as paths, Program(tmp_path / "p", prefix=paths.inside) as proxy:
            run_in_reactor(lambda: fly(paths, proxy), timeout_s=60)
    finally:
        globalLogPublisher.removeObserver(log)
    assert left == ["path_silent", "better_path", "path_silent"]
