"""Ground stations on the aircraft's own network."""

import json
import socket

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mission_control_cog.ground_connection import GroundConnection
from mission_control_cog.grounds import MAX_STATIONS, Grounds
from twisted.internet.task import Clock
from twisted.internet.testing import StringTransport

from tests.cogs.mission_control_cog.system import Aircraft, listening
from tests.cogs.peers import connect
from tests.support.reactor import reactor, until
from up.commands.altitude_command import AltitudeCommand
from up.commands.arming_commands import ArmCommand
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryFrequencyCommand
from up.life_cycle import LifeCycle
from up.protocols.control_lease import ALIVE_S
from up.protocols.proxy_lines import Accepted, Access, Hello
from up.system.peer_filter import PeerFilter

LISTENER = "listener: {port: 0, address: 127.0.0.1}\n"


def period(ms, id_):
    return {"name": "up.telemetry.frequency", "data": {"frequency": ms}, "id": id_}


async def grounds(aircraft, *hellos):
    """Connect stations, each after the one before is known."""
    peers = []
    for hello in hellos:
        peer = await connect(reactor, aircraft.up.ports["ground"])
        if hello:
            peer.say(hello)
            await until(lambda peer=peer: b"UP1 ok" in peer.received)
        await until(lambda peer=peer: peer.named("up.telemetry.update"))
        peers.append(peer)
    return peers


def test_the_first_has_control_and_the_others_listen(tmp_path):
    @listening(tmp_path, LISTENER)
    async def _(a):
        a.listen_to(TelemetryFrequencyCommand, LinkStateCommand)
        one, two = await grounds(a, b"", b"")
        one.say(period(100, "a"))
        assert (await one.answer("a"))["name"] == "up.ack"
        two.say(period(200, "a"))
        refused = await two.answer("a")
        assert refused["data"]["code"] == "forbidden"
        one.say(period(300, "b"))
        await one.answer("b")
        commands = [c.period_ms for c in a.heard if isinstance(c, TelemetryFrequencyCommand)]
        assert commands == [100, 300]
        a.provider.send_command(AltitudeCommand(5))
        for each in (one, two):
            await until(lambda each=each: each.named("up.altitude.change"))
        counters = a.up.telemetry_controller.collect()["counters"]["ground"]
        assert counters == {"stations": 2, "not_holder": 1, "too_many": 0, "refused_peers": 0}
        # The holder leaves; without a token its seat goes to the next sender.
        await one.close()
        two.say(period(400, "c"))
        assert (await two.answer("c"))["name"] == "up.ack"
        states = [c.connected for c in a.heard if isinstance(c, LinkStateCommand)]
        assert states == [True, False, True]
        await two.close()


def test_a_hello_is_answered_as_by_a_proxy_and_its_token_resumes_control(tmp_path):
    @listening(tmp_path, LISTENER + "aircraft: glider\n")
    async def _(a):
        hello = b"UP1 aircraft=glider seat=command\n"
        one, two = await grounds(a, hello, hello)
        assert one.lines[0].startswith(b"UP1 ok aircraft=glider seat=command token=")
        assert two.lines[0].startswith(b"UP1 ok aircraft=glider seat=listen token=")
        token = one.lines[0].rpartition(b"=")[2]
        await one.close()
        # The seat is kept for its token.
        two.say(period(200, "t"))
        assert (await two.answer("t"))["data"]["code"] == "forbidden"
        (again,) = await grounds(a, hello[:-1] + b" token=" + token + b"\n")
        assert again.lines[0] == b"UP1 ok aircraft=glider seat=command token=" + token
        again.say(b"UP1 seat release\n", period(300, "r"))
        assert (await again.answer("r"))["name"] == "up.ack"
        # A half-open holder is displaced by its own token immediately.
        (third,) = await grounds(a, hello[:-1] + b" token=" + token + b"\n")
        await again.closed
        third.say(period(330, "s"))
        assert (await third.answer("s"))["name"] == "up.ack"
        for peer in (two, third):
            await peer.close()


def test_a_wrong_token_and_a_listener_gain_no_control(tmp_path):
    @listening(tmp_path, LISTENER)
    async def _(a):
        (watcher,) = await grounds(a, b"UP1 aircraft=default seat=listen\n")
        assert b"seat=listen" in watcher.lines[0]
        (owner,) = await grounds(a, b"UP1 aircraft=default seat=command\n")
        assert b"seat=command" in owner.lines[0]
        token = b"00" * 16
        (other,) = await grounds(a, b"UP1 aircraft=default seat=command token=%s\n" % token)
        assert b"seat=listen" in other.lines[0]
        assert token not in other.lines[0]
        malformed = await connect(reactor, a.up.ports["ground"])
        malformed.say(b"UP1 aircraft=default token=ab\n")
        await malformed.closed
        assert malformed.lines[0].startswith(b"UP1 error code=malformed ")
        owner.say(period(50, "mine"))
        assert (await owner.answer("mine"))["name"] == "up.ack"
        for peer in (watcher, owner, other):
            await peer.close()


def test_the_role_is_the_links_and_partial_lines_end_with_their_connection(tmp_path):
    @listening(tmp_path, LISTENER)
    async def _(a):
        a.listen_to(ArmCommand, TelemetryFrequencyCommand)
        (one,) = await grounds(a, b"")
        beacon = one.named("up.telemetry.update")[-1]["beacon"]
        one.say({"name": "up.arm", "id": "arm", "beacon": beacon})
        assert (await one.answer("arm"))["data"]["code"] == "forbidden"
        one.say(b'{"name": "up.telemetry.frequency", "data": {"frequency": 1')
        await one.close()
        (two,) = await grounds(a, b"")
        two.say(b"50}}\n", period(900, "arm"))
        # An id that another station used is its own.
        assert (await two.answer("arm"))["name"] == "up.ack"
        assert a.heard == [TelemetryFrequencyCommand(900)]
        await two.close()


def test_hostile_stations_are_bounded(tmp_path):
    @listening(tmp_path, LISTENER)
    async def _(a):
        peers = [await connect(reactor, a.up.ports["ground"]) for _ in range(MAX_STATIONS)]
        late = await connect(reactor, a.up.ports["ground"])
        await late.closed
        peers[0].say(b"\xff\xff\n", b"[" * 20000 + b"\n", b"UP1 " + b"x" * 30000 + b"\n")
        peers[0].say({"name": "up.system.stop", "id": "s"}, period(50, "end"))
        assert (await peers[0].answer("s"))["data"]["code"] == "forbidden"
        assert (await peers[0].answer("end"))["name"] == "up.ack"
        for peer in peers:
            await peer.close()


async def test_a_port_in_use_is_a_veto_and_the_uplink_runs(tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        number = taken.getsockname()[1]
        text = f"listener: {{port: {number}, address: 127.0.0.1}}\n"
        a = Aircraft(tmp_path, None, text)
        life = LifeCycle(a.up)
        await life.start()
        (reason,) = a.up.vetoes.own.values()
        assert f"{number}" in reason
        assert "(mission_control.yml: listener.port)" in reason
        assert a.provider.started
        await life.stop()


async def test_a_public_address_and_a_public_peer_are_refused(tmp_path, monkeypatch):
    a = Aircraft(tmp_path / "a", None, "listener: {port: 0, address: 203.0.113.1}\n")
    life = LifeCycle(a.up)
    await life.start()
    (reason,) = a.up.vetoes.own.values()
    assert "(mission_control.yml: listener.address)" in reason
    await life.stop()
    async with Aircraft(tmp_path / "b", None, "listener: {port: 0}\n") as b:
        monkeypatch.setattr("up.system.peer_filter.is_private", lambda host: False)
        peer = await connect(reactor, b.up.ports["ground"])
        await peer.closed
        assert peer.received == b""


class Station:
    """A connection without a network: the data that the aircraft read from it."""

    def __init__(self, grounds_, clock, handle=None):
        self.link = grounds_.build()
        self.wire = StringTransport()
        # What TCP has and this transport has not.
        self.wire.setTcpNoDelay = self.wire.setTcpKeepAlive = lambda on: None
        self.wire.getHandle = lambda: handle or socket.socket()
        self.clock = clock
        self.link.makeConnection(self.wire)

    @property
    def received(self):
        self.link.output.resumeProducing()
        return self.wire.value()


class _Link:
    def nack(self, *_):
        pass


def virtual(clock, heard):
    return Grounds(
        clock, PeerFilter(True, "k"), "a",
        open_link=lambda send: _Link(),
        on_message=lambda message, link: heard.append(message.id),
        on_malformed=lambda fault, link: None,
        on_owner=lambda peer: None,
    )  # fmt: skip


def line(id_):
    return json.dumps({"name": "x", "id": id_}).encode() + b"\n"


def quiet(monkeypatch):
    monkeypatch.setattr("up.protocols.general_message_link.watch_peer", lambda *_: None)


def test_an_owner_that_is_silent_for_three_seconds_loses_control(monkeypatch):
    quiet(monkeypatch)
    clock, heard = Clock(), []
    all_ = virtual(clock, heard)
    one, two = Station(all_, clock), Station(all_, clock)
    one.link.dataReceived(line("1"))
    clock.advance(ALIVE_S)
    two.link.dataReceived(line("too early"))
    one.link.dataReceived(b"\n")
    clock.advance(ALIVE_S)
    two.link.dataReceived(line("still too early"))
    clock.advance(0.1)
    two.link.dataReceived(line("2"))
    one.link.dataReceived(line("too late"))
    assert heard == ["1", "2"]
    assert all_.dropped == 3


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@given(st.lists(st.integers(1, 60), max_size=12), st.booleans())
def test_the_first_line_may_come_in_any_pieces(monkeypatch, sizes, hello):
    quiet(monkeypatch)
    clock, heard, hellos = Clock(), [], []
    link = GroundConnection(
        clock,
        on_hello=lambda _, given_: hellos.append(given_) or Accepted("a", Access.LISTEN, "ab" * 16),
        on_message=lambda _, message: heard.append(message.id),
        on_malformed=lambda *_: heard.append("malformed"),
        on_connected=lambda _: None,
        on_lost=lambda *_: None,
    )
    link.makeConnection(StringTransport())
    first = b"UP1 aircraft=a seat=listen token=" + b"ab" * 16 + b"\n" if hello else b""
    data = first + line("1") + line("2")
    for size in sizes:
        link.dataReceived(data[:size])
        data = data[size:]
        if not data:
            break
    if data:
        link.dataReceived(data)
    assert heard == ["1", "2"]
    assert hellos == ([Hello("a", Access.LISTEN, "ab" * 16)] if hello else [])


def test_nothing_reaches_a_station_before_the_answer_to_its_hello():
    clock = Clock()
    all_ = virtual(clock, [])
    with socket.socket() as handle:
        station, silent = Station(all_, clock, handle), Station(all_, clock, handle)
        assert not all_.send_newest(b"too early\n") and not all_.send(b"too early\n")
        station.link.dataReceived(b"UP1 aircraft=a seat=com")
        assert not all_.send_newest(b"too early\n")
        station.link.dataReceived(b"mand\n")
        assert all_.send(b"word\n")
        assert station.received.startswith(b"UP1 ok ") and b"too early" not in station.received
        assert silent.received == b""
        # A peer that has sent nothing for a second sends no hello.
        clock.advance(1.0)
        assert all_.send(b"for all\n")
        assert silent.received == b"for all\n"


@pytest.mark.parametrize("text", ["", "listener: {port: }\n"])
def test_no_port_no_listener(tmp_path, text):
    @listening(tmp_path, text)
    async def _(a):
        assert "ground" not in a.up.ports
