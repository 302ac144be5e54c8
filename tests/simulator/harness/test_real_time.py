"""A world in real time: in step with the clock, never after it, its line at the line's rate."""

import os

import pytest
from twisted.internet.task import Clock

from up_rig.pty_line import PtyLine
from up_rig.sticks import read_sticks
from up_simulator.aircraft import FlightDynamics, load_airframe
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.harness.real_time import RealTimeFlight, RealTimeWorld
from up_simulator.harness.user_log import LogLine
from up_simulator.harness.world import World
from up_simulator.radio.choice import ScriptedRadio
from up_simulator.radio.sticks import SWITCH_US


class EchoBoard(DirectBoard):
    """A board that echoes its input, and records the times of reception, and its switches."""

    def __init__(self):
        super().__init__(seed=1)
        self.received = []
        self.switched = []

    def set_stick(self, channel, width_us):
        super().set_stick(channel, width_us)
        if channel == "aux1":
            self.switched.append(width_us)

    def write(self, data):
        self.received.append((self.now_us, data))

    def read(self):
        return (
            self.received[-1][1]
            if self.received and self.received[-1][0] + 2000 == self.now_us
            else b""
        )


class Flown:
    """A world on a line, its clock, and its output."""

    def __init__(self, script=""):
        self.clock, self.logged = Clock(), []
        self.clock.advance(100.0)
        self.board = EchoBoard()
        self.line = PtyLine()
        world = World(FlightDynamics(load_airframe("glider")), self.board)
        radio = ScriptedRadio(read_sticks(script))
        self.made = RealTimeWorld(world, self.line, radio, self.clock, self.log)

    def log(self, text, /, *, code="", **fields):
        self.logged.append(LogLine(text, code, fields))

    @property
    def time_s(self):
        return self.made.world.time_s

    def run(self, seconds, tick_s=0.004):
        for _ in range(round(seconds / tick_s)):
            self.clock.advance(tick_s)
            self.made.advance()


@pytest.fixture
def flown():
    made = Flown("t=0.5 aileron=1600 t=1 receiver=off")
    yield made
    made.line.close()


def test_it_flies_as_long_as_the_clock_ran(flown):
    flown.run(1.0)
    flown.run(1.0, tick_s=0.02)
    assert flown.time_s == pytest.approx(2.0)
    assert flown.logged == []


def test_a_short_delay_is_flown_in_bounded_turns(flown):
    flown.clock.advance(0.2)
    flown.made.advance()
    assert flown.time_s == pytest.approx(0.05)
    for _ in range(3):
        flown.made.advance()
    assert flown.time_s == pytest.approx(0.2)
    assert flown.made.time.skipped_s == 0.0


def test_missed_time_is_skipped_and_logged(flown):
    flown.clock.advance(3.0)
    for _ in range(20):
        flown.made.advance()
    assert flown.time_s == pytest.approx(0.25)
    assert flown.made.time.skipped_s == pytest.approx(2.75)
    (line,) = flown.logged
    assert line.has("late", late_s=3.0)
    flown.run(1.0)
    assert flown.time_s == pytest.approx(1.25)


def test_lateness_is_logged_at_most_once_a_minute(flown):
    for _ in range(100):
        flown.clock.advance(1.0)
        flown.made.advance()
    assert len(flown.logged) == 2


def test_the_sticks_move_in_simulated_time(flown):
    flown.run(0.6)
    assert flown.board.pulses_us()[0] == pytest.approx(1600)


def test_bytes_pass_both_ways_at_the_baud_rate(flown):
    file = os.open(flown.line.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    os.write(file, bytes(range(1, 231)))
    flown.run(0.1)
    assert b"".join(data for _, data in flown.board.received) == bytes(range(1, 231))
    first_us, last_us = flown.board.received[0][0], flown.board.received[-1][0]
    assert last_us - first_us == pytest.approx(18_000), "230 bytes take ten steps of 2 ms"
    assert os.read(file, 4096) == bytes(range(1, 231))
    os.close(file)


def test_a_relaunch_does_not_count_as_a_delay_and_ends_the_flight_mode_by_the_switch(flown):
    flown.run(1.0)
    flown.board.switched.clear()

    def boot(world):
        flown.clock.advance(5.0)

    flown.made.relaunch(boot)
    assert flown.board.switched == [SWITCH_US["FBW"]]
    flown.run(1.0)
    assert flown.board.switched[1:] == [SWITCH_US["AUTO"]]
    assert flown.time_s == pytest.approx(2.0)
    assert flown.logged == []


def test_a_flight_without_a_board_skips_missed_time():
    clock, flight, logged = Clock(), Advanced(), []
    made = RealTimeFlight(flight, clock, lambda _text, **fields: logged.append(fields))
    for passed_s in (0.005, 0.2, 3.0, 0.005):
        clock.advance(passed_s)
        made.advance()
    assert flight.durations_s == [0.005, 0.2, 0.25, 0.005]
    assert made.time.skipped_s == pytest.approx(2.75)
    assert logged == [{"code": "late", "late_s": 3.0}]


class Advanced:
    def __init__(self):
        self.durations_s = []

    def advance(self, duration_s):
        self.durations_s.append(round(duration_s, 6))
