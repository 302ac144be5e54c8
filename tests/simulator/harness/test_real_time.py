"""A world in real time: in step with the clock, never after it, its line at the line's rate."""

import os

import pytest
from twisted.internet.task import Clock

from up_rig.pty_line import PtyLine
from up_rig.sticks import read_sticks
from up_simulator.aircraft.recorded_flight import read_recording
from up_simulator.aircraft.replayed import ReplayedFlight
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.harness.real_time import RealTimeWorld
from up_simulator.harness.world import World
from up_simulator.radio.scripted import ScriptedRadio


class EchoBoard(DirectBoard):
    """A board that echoes its input, and records the times of reception."""

    def __init__(self):
        super().__init__(seed=1)
        self.heard = []

    def write(self, data):
        self.heard.append((self.now_us, data))

    def read(self):
        return self.heard[-1][1] if self.heard and self.heard[-1][0] + 2000 == self.now_us else b""


class Flown:
    """A world on a line, its clock, and its output."""

    def __init__(self, script=""):
        self.clock, self.said = Clock(), []
        self.clock.advance(100.0)
        self.board = EchoBoard()
        self.line = PtyLine()
        world = World(ReplayedFlight(read_recording(None)), self.board)
        radio = ScriptedRadio(read_sticks(script))
        self.made = RealTimeWorld(world, self.line, radio, self.clock, self.said.append)

    @property
    def time_s(self):
        return self.made.world.time_s

    def run(self, seconds, tick_s=0.004):
        for _ in range(round(seconds / tick_s)):
            self.clock.advance(tick_s)
            self.made.keep()


@pytest.fixture
def flown():
    made = Flown("t=0.5 aileron=1600 t=1 receiver=off")
    yield made
    made.line.close()


def test_it_flies_as_long_as_the_clock_ran(flown):
    flown.run(1.0)
    flown.run(1.0, tick_s=0.02)
    assert flown.time_s == pytest.approx(2.0)
    assert flown.said == []


def test_a_hold_up_is_caught_up_with_in_turns_not_in_a_heap(flown):
    flown.clock.advance(0.2)
    flown.made.keep()
    assert flown.time_s == pytest.approx(0.05)
    for _ in range(3):
        flown.made.keep()
    assert flown.time_s == pytest.approx(0.2)
    assert flown.made.skipped_s == 0.0


def test_missed_time_is_skipped_and_said(flown):
    flown.clock.advance(3.0)
    for _ in range(20):
        flown.made.keep()
    assert flown.time_s == pytest.approx(0.25)
    assert flown.made.skipped_s == pytest.approx(2.75)
    assert flown.said == ["late by 3.00 s: the missed time is skipped, not flown"]
    flown.run(1.0)
    assert flown.time_s == pytest.approx(1.25)


def test_it_says_so_at_most_every_5_s(flown):
    for _ in range(10):
        flown.clock.advance(1.0)
        flown.made.keep()
    assert len(flown.said) == 2


def test_the_sticks_are_moved_in_the_worlds_time(flown):
    flown.run(0.6)
    assert flown.board.pulses_us()[0] == pytest.approx(1600)


def test_bytes_go_both_ways_at_the_rate_of_the_line(flown):
    file = os.open(flown.line.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    os.write(file, bytes(range(1, 231)))
    flown.run(0.1)
    assert b"".join(data for _, data in flown.board.heard) == bytes(range(1, 231))
    first_us, last_us = flown.board.heard[0][0], flown.board.heard[-1][0]
    assert last_us - first_us == pytest.approx(18_000), "230 bytes take ten steps of 2 ms"
    assert os.read(file, 4096) == bytes(range(1, 231))
    os.close(file)


def test_a_new_beginning_takes_no_time(flown):
    flown.run(1.0)

    def boot(world):
        flown.clock.advance(5.0)

    flown.made.begin_again(boot)
    flown.run(1.0)
    assert flown.time_s == pytest.approx(2.0)
    assert flown.said == []
