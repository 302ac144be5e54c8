"""Telemetry on goggles at a real pty, decoded by the format; time is the test's."""

import select

import pytest
from msp_cog.codec import encode
from msp_cog.modules.goggles_osd import GogglesOsd
from twisted.internet.defer import Deferred
from twisted.logger import capturedLogs

from tests.cogs.serial_cog.rig import VirtualReactor, run
from tests.support.system import build_up, started
from up.commands.telemetry_commands import TelemetryCommand
from up.protocols.serial_line import LAST_FRAME_S
from up_rig.pty_line import PtyLine
from up_simulator.radio.goggles import Goggles

STEP_S = 0.05
FLYING = {
    "armed": True,
    "flight_mode": "SETPOINT",
    "flight_control": {"mode": "LOITER"},
    "arduino": {"flight_battery_v": 11.38},
    "navigation": {"height": 123.4, "speed": 14.6, "airspeed": 13.2, "heading": 350.0},
    "home": {"latitude": 50.0, "distance": 240.4, "bearing": 35.0},
    "location": {"satellites": 12},
    "failsafe": {"active": [], "cause": None},
    "age_ms": {"navigation": 20, "flight": 20, "location": 100},
}


class OsdRig:
    """``send`` is the next telemetry, every 0.1 s; None: none."""

    def __init__(self, folder, text="grid: 30x16\n"):
        self.line = PtyLine(folder / "goggles")
        self.reactor = VirtualReactor()
        files = {"osd.yml": f"port: {self.line.path}\n{text}"}
        # Without builtins telemetry is the test's alone.
        config = folder / "config"
        self.up = build_up([GogglesOsd], self.reactor, config, config=files, builtins=False)
        self.osd = self.up.get_module(GogglesOsd)
        columns, rows = self.osd.config.size
        self.goggles = Goggles(columns, rows)
        self.telemetry, self.commands = FLYING, []
        self.up.command_executor.add_observer(lambda command, _: self.commands.append(command))
        self.life = run(started(self.up))

    def advance(self, seconds, *, reads=True):
        for step in range(round(seconds / STEP_S)):
            if self.telemetry is not None and step % 2 == 0:
                self.up.command_executor.execute_command(TelemetryCommand(self.telemetry, 1))
            self.reactor.advance(STEP_S)
            self.reactor.turn()
            if reads:
                self.read()

    def stop(self):
        stopped = Deferred.fromCoroutine(self.life.stop())
        self.reactor.turn()
        self.read()
        self.reactor.advance(LAST_FRAME_S)
        assert stopped.called
        self.line.close()

    def read(self):
        while select.select([self.line._own], [], [], 0)[0]:
            self.goggles.feed(self.line.read(0.0, 4096))
        assert self.goggles.errors == 0

    def request(self, *frames):
        self.line.write(b"".join(frames))
        self.advance(0.2)

    def with_values(self, **parts):
        self.telemetry = {**FLYING, **parts}
        self.advance(0.4)
        return self.goggles

    @property
    def counters(self):
        return self.osd.telemetry_content["counters"]["osd"]


@pytest.fixture
def rig(tmp_path):
    made = OsdRig(tmp_path)
    made.advance(1.3)
    yield made
    made.stop()


def test_the_readings_of_telemetry(rig):
    shown = rig.goggles
    assert shown.row(1) == " LOITER".ljust(23) + "00:01"
    assert shown.row(2) == " HOME 240M R045"
    assert shown.row(6) == " GS 15M/S".ljust(20) + "ALT 123M"
    assert shown.row(7) == " AS 13M/S"
    assert shown.row(14) == " BAT 11.4V".ljust(22) + "SAT 12"
    assert shown.row(11) == ""
    rig.advance(64.0)
    assert shown.row(1)[23:] == "01:05"
    rig.with_values(armed=False, flight_mode="FBW", home={**FLYING["home"], "bearing": 200.0})
    assert shown.row(1) == " FBW*".ljust(23) + "--:--"
    assert shown.row(2) == " HOME 240M L150"
    rig.with_values(home={**FLYING["home"], "distance": 12_345})
    assert shown.row(2) == " HOME 12.3KM R045"


def test_what_is_unknown_or_stale_is_dashes(rig):
    shown = rig.with_values(age_ms={"navigation": 3100, "flight": 20, "location": 100})
    assert shown.row(6) == " GS ---M/S".ljust(20) + "ALT ---M"
    assert shown.row(2) == " HOME 240M ----" and shown.row(14) == " BAT 11.4V".ljust(22) + "SAT 12"
    rig.with_values(age_ms={"navigation": 20, "flight": 1000, "location": 2000})
    assert shown.row(1)[:6] == " ---- "
    assert shown.row(2) == " HOME ---M ----" and shown.row(14) == " BAT --.-V".ljust(22) + "SAT ---"
    # Until home is set, telemetry has the distance to the first position.
    rig.with_values(home={"latitude": None, "distance": 3.0, "bearing": 0.0})
    assert shown.row(2) == " HOME ---M ----"
    rig.with_values(navigation={}, arduino={"flight_battery_v": None}, location={})
    assert shown.row(6) == " GS ---M/S".ljust(20) + "ALT ---M"


def test_without_telemetry_nothing_looks_live(tmp_path):
    rig = OsdRig(tmp_path)
    rig.advance(1.0)
    rig.telemetry = None
    rig.advance(1.2)
    shown = rig.goggles
    assert shown.row(1) == " ----".ljust(23) + "--:--"
    assert shown.row(6) == " GS ---M/S".ljust(20) + "ALT ---M"
    assert shown.row(11) == "  NO DATA"
    rig.stop()
    assert "".join(shown.shown).strip() == "" and shown.operations[-3:] == [2, 4, 1]


def test_warnings_one_after_the_other(rig):
    def seen(**parts):
        found = set()
        for _ in range(15):
            found.add(rig.with_values(**parts).row(11).strip())
        return found

    navigation = {**FLYING["navigation"], "motor_stopped": True}
    failsafe = {"active": ["uplink_lost", "fence"], "cause": "uplink_lost"}
    assert seen(navigation=navigation, failsafe=failsafe) == {
        "FAILSAFE UPLINK LOST", "MOTOR STOPPED", "UPLINK LOST", "FENCE",
    }  # fmt: skip
    arduino = {"flight_battery_critical": True, "receiver_valid": False, "connected": False}
    assert seen(arduino=arduino) == {"FLIGHT BATTERY CRITICAL", "RECEIVER LOST", "BOARD LOST"}
    # A phone that was never there is not lost.
    assert seen(android={"connected": False}) == {""}


def test_only_what_changed_is_sent_and_lost_bytes_are_repaired(rig):
    # In a second: 10 heartbeats, the time's digit, two rows again.
    begin = rig.goggles.received
    rig.advance(4.0)
    assert rig.goggles.received - begin < 4 * 250
    rig.goggles._cells.clear()
    rig.goggles._cells[9, 3] = "X"
    rig.advance(8.5)
    assert rig.goggles.row(6) == " GS 15M/S".ljust(20) + "ALT 123M" and rig.goggles.row(9) == ""


def test_bytes_are_bounded_whatever_changes_or_is_requested(tmp_path):
    # With the highest rate the whole first screen is sent in one step.
    rig = OsdRig(tmp_path, "grid: 53x20\nbytes_per_s: 10000\n")
    rig.advance(0.4)
    assert rig.goggles.row(6) == " GS 15M/S".ljust(43) + "ALT 123M"
    assert rig.counters["dropped"] == 0
    rig.stop()
    rig = OsdRig(tmp_path, "grid: 53x20\nbytes_per_s: 1000\n")
    rig.advance(1.0)
    begin = rig.goggles.received
    for step in range(40):
        rig.telemetry = {**FLYING, "navigation": {"height": step, "speed": step, "airspeed": step}}
        rig.line.write(encode(2) * 100)
        rig.advance(0.1)
    assert rig.goggles.received - begin <= 4.1 * 1000
    assert rig.counters["unanswered"] > 1000 and len(rig.goggles.answers) > 100
    rig.stop()


def test_goggles_get_their_answers_and_a_grid_that_differs_is_reported_once(rig):
    with capturedLogs() as events:
        rig.request(encode(2), encode(101), encode(189), encode(188, bytes((30, 16))))
        rig.request(encode(188, bytes((50, 18))), encode(188, bytes((50, 18))))
    assert [each["code"] for each in events if "code" in each] == ["grid_differs"]
    assert rig.osd.telemetry_content["osd"] == {"is_open": True, "goggles": "50x18"}
    known = [number for head, number, _ in rig.goggles.answers if head == b">"]
    assert known == [2, 101, 189, 188, 188, 188]
    assert rig.goggles.answers[1][2][6:10] == b"\1\0\0\0"
    assert rig.goggles.answers[2][2] == bytes((30, 16))


def test_attack_nothing_that_arrives_becomes_a_command(rig):
    """Sticks, arming, modes and settings of MSP, frames of other protocols, noise."""
    rig.commands.clear()
    orders = [encode(number, b"\x01" * size) for number in range(255) for size in (0, 1, 16)]
    for begin in range(0, len(orders), 60):
        rig.request(*orders[begin : begin + 60], b"$X<\0", bytes(range(256)))
    assert {type(each) for each in rig.commands} == {TelemetryCommand}
    accepted = {number for head, number, _ in rig.goggles.answers if head == b">"}
    assert accepted <= {2, 88, 101, 119, 188, 189} and rig.counters["other"] > 500


def test_a_reader_that_stops_gets_the_whole_screen_when_it_reads_again(rig):
    rig.telemetry = {**FLYING, "navigation": {**FLYING["navigation"], "height": 7.0}}
    rig.goggles._cells.clear()
    rig.advance(20.0, reads=False)
    rig.advance(10.0)
    assert rig.goggles.row(6) == " GS 15M/S".ljust(20) + "ALT 7M"


def test_without_a_port_it_is_not_loaded(tmp_path):
    up = build_up([GogglesOsd], VirtualReactor(), tmp_path / "config", config={"osd.yml": ""})
    assert up.get_module(GogglesOsd) is None
