"""Telemetry is sampled at its period, whatever modules and the ground do."""

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.task import Clock
from twisted.logger import globalLogPublisher

from tests.support.system import build_up, started
from tests.up.commands.samples import Log
from up.base_module import BaseModule
from up.commands.origin import Origin
from up.commands.panic_command import PanicCommand
from up.commands.refusal import Code
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryCommand, TelemetryFrequencyCommand
from up.telemetry_controller import LOG_INTERVAL_S, TelemetryController


class Speaker(BaseModule):
    """Reports the values that a test sets."""

    content = {}

    @property
    def telemetry_content(self):
        if isinstance(self.content, BaseException):
            raise self.content
        return self.content


class Rig:
    """Telemetry of two modules; ``frames`` are (time, content, beacon)."""

    def __init__(self, folder):
        self.clock = Clock()
        rival = type("Rival", (BaseModule,), dict(vars(Speaker)))
        self.up = build_up((Speaker, rival), self.clock, folder)
        self.speaker, self.rival = self.up.get_module(Speaker), self.up.get_module(rival)
        self.controller = self.up.get_module(TelemetryController)
        self.frames = []
        self.up.command_executor.register_command(TelemetryCommand, self._hear)
        got = []
        Deferred.fromCoroutine(started(self.up)).addBoth(got.append)
        self.life = got[0]

    def _hear(self, command):
        self.frames.append((round(self.clock.seconds(), 3), command.content, command.beacon))

    def run(self, seconds, step_s=0.01):
        self.clock.pump([step_s] * round(seconds / step_s))

    def period(self, period_ms):
        self.up.command_executor.execute_command(TelemetryFrequencyCommand(period_ms))

    @property
    def times(self):
        return [frame[0] for frame in self.frames]


@pytest.fixture
def rig(tmp_path):
    return Rig(tmp_path)


def test_ten_a_second_with_beacons_that_count_up(rig):
    rig.run(1.05)
    assert rig.times == pytest.approx([tenth / 10 for tenth in range(1, 11)], abs=0.011)
    first = rig.frames[0][2]
    assert [frame[2] for frame in rig.frames] == list(range(first, first + 10))
    assert rig.up.beacons.is_fresh(first)


def test_each_frame_tells_the_clock_of_the_moment_it_was_collected(rig):
    rig.run(0.45)
    told_ms = [content["system"]["clock_ms"] for _, content, _ in rig.frames]
    assert told_ms == [round(time_s * 1000) for time_s in rig.times]
    assert all(type(each) is int for each in told_ms)


def test_the_ground_sets_the_period(rig):
    rig.period(20)
    rig.run(0.2)
    assert len(rig.frames) in (9, 10)
    rig.period(1000)
    rig.frames.clear()
    rig.run(3.1)
    assert len(rig.frames) == 4, "the one that was due tells the new period"


def test_a_period_that_is_set_thousands_of_times_does_not_fill_the_log(rig):
    lines = []

    def observer(event):
        lines.append(event.get("code"))

    globalLogPublisher.addObserver(observer)
    try:
        for number in range(3000):
            rig.period(100 + number % 2)
            rig.run(0.01)
    finally:
        globalLogPublisher.removeObserver(observer)
    assert 1 <= lines.count("period_changed") <= 2 + 30 / LOG_INTERVAL_S
    assert rig.controller.period_ms == 101


def test_a_ground_that_sets_the_period_again_and_again_starves_nobody(rig):
    for _ in range(50):
        rig.period(100)
        rig.run(0.05)
    assert len(rig.frames) in (24, 25)


def test_panic_lengthens_the_period_and_never_shortens_it(rig):
    bus = rig.up.command_executor
    bus.execute_command(PanicCommand(True, 500))
    rig.run(2.05)
    assert len(rig.frames) == 4
    rig.frames.clear()
    bus.execute_command(PanicCommand(True, 10))
    rig.run(1.0)
    assert len(rig.frames) in (10, 11)
    bus.execute_command(PanicCommand(True, 500))
    bus.execute_command(PanicCommand(False, 10))
    rig.frames.clear()
    rig.run(1.0)
    assert len(rig.frames) in (10, 11)


def test_panic_refuses_a_shorter_period_and_keeps_the_one_before(rig):
    bus = rig.up.command_executor
    answers = []

    def ask(period_ms):
        origin = Origin("ground", Role.OPERATOR)
        done = bus.execute_and_wait(TelemetryFrequencyCommand(period_ms), origin)
        done.addErrback(lambda failure: failure.value.code)
        done.addCallback(answers.append)

    bus.execute_command(PanicCommand(True, 150))
    ask(50)
    assert (answers.pop(), rig.controller.period_ms) == (Code.OVERLOADED, 150)
    ask(150)
    ask(200)
    assert (answers, rig.controller.period_ms) == ([None, None], 200)
    bus.execute_command(PanicCommand(False, 50))
    assert rig.controller.period_ms == 200
    ask(50)
    assert (answers[2:], rig.controller.period_ms) == ([None], 50)


def test_a_late_reactor_sends_no_backlog(rig):
    rig.run(0.2)
    rig.frames.clear()
    rig.clock.advance(5)
    rig.run(0.02)
    assert len(rig.frames) <= 2


def test_a_module_that_raises_costs_its_own_content_and_is_named_once(rig):
    rig.speaker.content = RuntimeError("no telemetry today")
    rig.rival.content = {"rival": 1}
    with Log() as log:
        rig.run(1.05)
    assert all(frame[1]["rival"] == 1 for frame in rig.frames)
    assert len(log.failures) == 1
    assert log.of("telemetry_failed")[0]["name"] == "Speaker"
    assert rig.frames[-1][1]["counters"]["telemetry"]["faults"] >= 9


@pytest.mark.parametrize("content", [7, "text", ["list"], SystemExit(1)])
def test_what_is_no_map_is_a_fault_too(rig, content):
    rig.speaker.content = content
    rig.run(0.25)
    assert len(rig.frames) == 2
    assert rig.controller.faults == 2


def test_a_conflict_names_both_and_is_counted(rig):
    rig.speaker.content = {"both": {"x": 1}}
    rig.rival.content = {"both": {"x": 2, "y": 3}}
    with Log() as log:
        rig.run(1.05)
    assert rig.frames[0][1]["both"] == {"x": 1, "y": 3}
    (event,) = log.of("telemetry_conflict")
    assert (event["key"], event["first"], event["later"]) == ("both.x", "Speaker", "Rival")
    assert rig.controller.conflicts == 10


def test_conflicts_with_ever_new_names_do_not_fill_memory_or_log(rig):
    with Log() as log:
        for number in range(3000):
            rig.controller._on_conflict(f"key{number}", "A", "B")
    assert len(log.events) == 1000


def test_the_systems_own_part(rig):
    rig.up.vetoes.set("pids.yml", "is corrupt")
    rig.up.count("reactor", {"SlowModule": 3})
    rig.run(0.15)
    content = rig.frames[0][1]
    assert content["vetoes"] == ["pids.yml: is corrupt"]
    assert content["counters"]["reactor"] == {"SlowModule": 3}
    assert content["system"] == {"uptime_s": 0, "clock_ms": 110, "period_ms": 100}
    assert content["mode"] == "flight controller"


def test_stopping_ends_it(rig):
    Deferred.fromCoroutine(rig.life.stop())
    rig.run(1)
    assert not rig.frames
    assert not rig.clock.getDelayedCalls()


def test_after_the_first_frame_nothing_is_collected_that_nobody_wants(rig):
    rig.wants_telemetry = False
    rig.run(5.0)
    assert len(rig.times) == 1
    rig.wants_telemetry = True
    rig.run(2.5)
    assert 5.0 < rig.times[1] <= 7.0
    assert rig.times[2] - rig.times[1] == pytest.approx(0.1)


def test_a_link_that_comes_up_has_telemetry_at_once(rig):
    rig.wants_telemetry = False
    rig.run(5.05)
    rig.wants_telemetry = True
    rig.up.command_executor.execute_command(LinkStateCommand("ground", True))
    rig.run(0.02)
    assert len(rig.times) == 2


def test_one_subscriber_that_says_nothing_of_it_wants_every_frame(rig):
    rig.wants_telemetry = False
    heard = []
    rig.up.command_executor.register_command(TelemetryCommand, heard.append)
    rig.run(1.05)
    assert len(heard) == 10


def test_a_beacon_is_fresh_for_as_long_as_the_ground_waits_for_the_next_frame(rig):
    """At 10 s a frame, a ground that sees every one is never refused as stale."""
    rig.run(0.15)
    assert rig.frames[-1][1]["system"]["period_ms"] == 100
    rig.period(10_000)
    rig.run(0.1)
    _, content, beacon = rig.frames[-1]
    assert content["system"]["period_ms"] == 10_000, "the frame that was due tells the new period"
    for _ in range(10):
        rig.clock.advance(1.0)
        assert rig.up.beacons.is_fresh(rig.frames[-1][2])
    assert rig.up.beacons.is_fresh(beacon), "the next frame is on its way"
    rig.clock.advance(1.1)
    assert not rig.up.beacons.is_fresh(beacon)
    rig.period(100)
    rig.run(2.5)
    assert not rig.up.beacons.is_fresh(rig.frames[-23][2]), "2 s again"
    assert rig.up.beacons.is_fresh(rig.frames[-18][2])
