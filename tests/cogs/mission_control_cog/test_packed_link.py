"""Presence and packed telemetry from aircraft to ground: real parts, one clock."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.cogs.mission_control_cog.virtual_link import STEP_S, Flying, Ground, Net
from up.base_module import BaseModule
from up.commands.altitude_command import AltitudeCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.protocols.attitude_frame import is_attitude
from up.protocols.binary_line import to_body
from up_proxy.aircraft import AircraftSession

RECOVERY_S = 1.0


@pytest.fixture
def net(monkeypatch):
    with Net(monkeypatch) as net:
        yield net


def kinds(wire_bytes):
    return {line[:1] for line in wire_bytes.split(b"\n") if line and not line.startswith(b"UP1")}


def test_nobody_watches_then_full_rate_within_300_ms(net, tmp_path):
    aircraft = Flying(net, tmp_path / "a")
    net.run(1)
    before, segments = aircraft.wire.bytes_out, aircraft.wire.segments
    net.run(30)
    # Three frames, packed, and nothing else.
    assert aircraft.wire.segments - segments == 3
    assert aircraft.wire.bytes_out - before < 3 * 250
    assert aircraft.up.beacons.was_sent(aircraft.up.beacons._next - 290)
    ground = Ground(net, tmp_path / "g")
    assert ground.link.status.is_aircraft_online
    assert net.run_until(lambda: len(ground.frames) >= 2, 5) <= 0.3
    net.run(2)
    assert len(ground.frames) >= 20
    assert ground.link.status.dropped == 0
    assert ground.telemetry.lost == 0
    assert ground.frames[-1][1].data["uplink"]["grounds"] == 1
    assert aircraft.provider.has_ground
    ground.stop()
    net.run(11)
    assert (aircraft.provider.connected, aircraft.provider.has_ground) == (True, False)
    before = aircraft.wire.bytes_out
    net.run(10)
    assert aircraft.wire.bytes_out - before < 250


def test_an_unwatched_aircraft_keeps_its_name_and_its_connection(net, tmp_path):
    aircraft = Flying(net, tmp_path / "a")
    net.run(40)
    thief = net.air("UP1 aircraft=a\n")
    thief.expect("code=taken")
    counters = aircraft.provider.telemetry_content["counters"]["mission_control"]
    assert counters["connects"] == 1
    assert aircraft.provider.connected


def test_a_path_that_swallows_everything_is_left(net, tmp_path):
    """As through a relay that acknowledges what it cannot pass on: TCP does not notice."""
    aircraft = Flying(net, tmp_path / "a")
    ground = Ground(net, tmp_path / "g")
    net.run(20)
    wire = aircraft.wire
    wire.is_dark = True
    assert 7 < net.run_until(lambda: wire.peer.closed, 30) <= 13
    net.run_until(lambda: aircraft.provider.connected, 5)
    now_s = net.now_s
    net.run_until(lambda: ground.frames[-1][0] > now_s, 1)
    ground.stop()
    net.run(40)
    wire = aircraft.wire
    wire.is_dark = True
    assert 15 < net.run_until(lambda: wire.peer.closed, 60) <= 40


def test_an_aircraft_that_hangs_is_found_idle(net):
    silent, _ = net.hello_air("a", " packed=1")
    net.pass_time(40)
    silent.expect_closed()


def test_the_lease_of_a_watched_aircraft_is_as_short_as_ever(net):
    silent, _ = net.hello_air("a", " packed=1")
    silent.expect("UP1 watch grounds=0 packed=1 attitude=1\n")
    net.pass_time(14)
    net.air("UP1 aircraft=a\n").expect("code=taken")
    ground, _ = net.hello_ground("a", extra=" packed=1")
    silent.expect("UP1 watch grounds=1 packed=1 attitude=0\n")
    net.pass_time(2.5, (ground,))
    net.air("UP1 aircraft=a\n").expect("code=taken")
    net.pass_time(1, (ground,))
    net.air("UP1 aircraft=a\n").expect("UP1 ok")


def test_one_ground_that_cannot_unpack_gets_whole_frames_and_so_do_all(net, tmp_path):
    Flying(net, tmp_path / "a")
    ground = Ground(net, tmp_path / "g")
    net.run(2)
    old, _ = net.hello_ground("a", "listen")
    net.run(2)
    assert kinds(old.heard) == {b"{"}
    assert old.heard.count(b"\n") > 10
    late_s = net.now_s
    net.run(1)
    assert ground.frames[-1][0] >= late_s
    assert ground.link.status.dropped == 0
    old.close()
    net.run(2)
    assert ground.frames[-1][0] > net.now_s - 0.3


def test_a_packed_line_on_its_way_never_reaches_a_ground_that_cannot_read_it(net):
    air, _ = net.hello_air("a", " packed=1")
    new, _ = net.hello_ground("a", "listen", extra=" packed=1")
    old, _ = net.hello_ground("a", "listen")
    air.say(b"\x01one\n{}\n\x02two\n\x01three\n")
    new.expect(b"\x01one\n{}\n\x02two\n\x01three\n")
    assert b"\x01" not in old.expect(b"{}\n\x02two\n")
    air.say(b"\x01four\n{}\n")
    old.expect(b"{}\n")
    assert b"\x01" not in old.heard


def test_the_budget_holds_and_what_it_leaves_out_is_not_lost(net, tmp_path):
    aircraft = Flying(net, tmp_path / "a", "data_budget_mb_per_hour: 1.5\n")
    ground = Ground(net, tmp_path / "g")
    net.run(10)
    wire, before = aircraft.wire, len(ground.frames)
    began = wire.bytes_out + 104 * wire.segments
    net.run(60)
    spent = (wire.bytes_out + 104 * wire.segments - began) / 1e6 * 60
    assert 1.3 < spent <= 1.5
    assert 60 < len(ground.frames) - before < 300
    assert ground.telemetry.lost == 0
    uplink = ground.frames[-1][1].data["uplink"]
    assert uplink["mb_per_hour"] == pytest.approx(spent, rel=0.05)
    assert uplink["left_out"] > 300


class Board(BaseModule):
    """Circles in a climb, measured 20 times a second, the altitude twice."""

    is_armed, item = True, 1

    @property
    def telemetry_content(self):
        ages = {"flight": 100}
        return {"armed": self.is_armed, "age_ms": ages, "mission": {"item": self.item}}

    def measure(self):
        now_s = self.context.reactor.seconds()
        execute = self.up.command_executor.execute_command
        turn = OrientationCommand(now_s % 60, now_s % 20, 5 * now_s % 360, 1.0, 2.0, 3.0)
        execute(turn, Origin("board", Role.BOARD))
        if round(20 * now_s) % 10 == 0:
            execute(AltitudeCommand(now_s), Origin("phone", Role.SENSOR))


class Circling(Flying):
    """An aircraft with a board and a data budget of 1.9 MB/h."""

    def __init__(self, net, folder):
        super().__init__(net, folder, "data_budget_mb_per_hour: 1.9\n", (Board,))
        self.board = self.up.get_module(Board)

    def run(self, seconds):
        for _ in range(round(seconds / STEP_S)):
            self.board.measure()
            self.net.run(STEP_S)


def test_with_a_small_budget_attitude_is_sent_alone_and_the_rest_keeps_its_age(net, tmp_path):
    aircraft = Circling(net, tmp_path / "a")
    ground = Ground(net, tmp_path / "g")
    aircraft.run(30)
    before, bytes_out = len(ground.frames), aircraft.wire.bytes_out
    aircraft.run(30)
    frames = ground.frames[before:]
    assert len(frames) > 3.9 * 30
    assert (aircraft.wire.bytes_out - bytes_out) / len(frames) < 35
    assert ground.telemetry.lost == 0
    assert ground.link.status.dropped == 0
    wholes = [each for each in frames if each[1].data["rates"]["roll"] is not None]
    assert 6 <= len(wholes) <= 10
    for now_s, message in frames:
        content = message.data
        made_s = content["system"]["clock_ms"] / 1000
        assert made_s == pytest.approx(now_s, abs=0.06)
        assert content["orientation"]["yaw"] == pytest.approx(5 * made_s % 360, abs=0.31)
        assert content["age_ms"]["orientation"] == 0
        # The altitude is the time at which it was measured, to the resolution of its age.
        age_ms = 1000 * (made_s - content["altitude"])
        assert content["age_ms"]["altitude"] == pytest.approx(age_ms, abs=320)
    # What changed is there immediately: an alarm, and a value that no age would show to be old.
    for armed, item in ((False, 1), (True, 2), (True, 3)):
        aircraft.board.is_armed, aircraft.board.item = armed, item
        aircraft.run(0.2)
        assert ground.telemetry.flag("armed") is armed
        assert ground.telemetry.number("mission", "item") == item
        aircraft.run(2.3)


def test_one_ground_that_reads_no_attitude_frames_gets_none_and_nor_do_the_others(net, tmp_path):
    aircraft = Circling(net, tmp_path / "a")
    ground = Ground(net, tmp_path / "g")
    aircraft.run(10)
    assert None in {each.data["rates"]["roll"] for _, each in ground.frames}
    old, _ = net.hello_ground("a", "listen", extra=" packed=1")
    aircraft.run(1)
    old.heard, before = b"", len(ground.frames)
    aircraft.run(10)
    lines = [line for line in old.heard.split(b"\n") if line and not line.startswith(b"UP1")]
    assert len(lines) > 15
    assert not any(is_attitude(to_body(line)) for line in lines)
    assert {each.data["rates"]["roll"] for _, each in ground.frames[before:]} == {1.0}


def test_an_old_proxys_aircraft_sends_whole_frames(net, tmp_path, monkeypatch):
    aircraft = Flying(net, tmp_path / "a")
    monkeypatch.setattr(AircraftSession, "report_watchers", lambda *_, **__: None)
    aircraft.provider._uplink._link.watchers = None
    plain, _ = net.hello_ground("a", "listen")
    net.run(2)
    assert kinds(plain.heard) == {b"{"}
    assert plain.heard.count(b"\n") > 15


def test_lines_about_watchers_are_rare_however_fast_grounds_come(net):
    air, _ = net.hello_air("a", " packed=1")
    for _ in range(20):
        ground, _ = net.hello_ground("a", "listen", extra=" packed=1")
        ground.say("UP1 key\n")
        ground.close()
    net.settle()
    assert air.heard.count(b"UP1 watch") == 1
    net.pass_time(2)
    assert air.heard.count(b"UP1 watch") == 2


def test_a_heartbeat_of_the_ground_costs_the_aircraft_nothing(net):
    air, _ = net.hello_air("a", " packed=1")
    ground, _ = net.hello_ground("a")
    net.settle()
    air.read()
    air.heard = b""
    net.pass_time(3, (ground, air))
    assert b"\n\n" not in b"\n" + air.heard


ACTIONS = st.lists(
    st.sampled_from(["join", "leave", "lose", "old joins", "old leaves", "proxy", "daemon"]),
    min_size=1,
    max_size=6,
)


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(actions=ACTIONS, lost=st.integers(1, 25))
def test_every_ground_has_telemetry_again_within_a_second(tmp_path, monkeypatch, actions, lost):
    with Net(monkeypatch) as net:
        aircraft, grounds, old = Flying(net, tmp_path / "a"), [Ground(net, tmp_path / "0")], []
        for number, action in enumerate(actions, 1):
            if action == "join":
                grounds.append(Ground(net, tmp_path / str(number)))
            elif action == "leave" and len(grounds) > 1:
                grounds.pop(0).stop()
            elif action == "lose":
                grounds[-1].wire.lose_lines = lost
                net.run_until(lambda: not grounds[-1].wire.lose_lines, 5)
            elif action == "old joins":
                old.append(net.hello_ground("a", "listen")[0])
            elif action == "old leaves" and old:
                old.pop().close()
            elif action == "proxy":
                net.restart_proxy()
                old.clear()
                net.run(0.1)
            elif action == "daemon":
                aircraft.stop()
                aircraft = Flying(net, tmp_path / f"a{number}")
            statuses = [each.link.status for each in grounds]
            net.run_until(
                lambda a=aircraft, s=statuses: a.provider.connected and all(x.is_open for x in s),
                30,
            )
            now_s = net.now_s
            net.run_until(
                lambda since_s=now_s: all(x.frames and x.frames[-1][0] > since_s for x in grounds),
                RECOVERY_S,
            )
        assert all(each.link.status.malformed == 0 for each in grounds)
