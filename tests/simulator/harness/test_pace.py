from twisted.internet.task import Clock

from up_simulator.harness.pace import Pace


class Flown:
    def __init__(self):
        self.pieces = []

    def advance(self, duration_s):
        self.pieces.append(round(duration_s, 6))


def make():
    clock, flight, said = Clock(), Flown(), []
    return clock, flight, said, Pace(flight, clock, said.append)


def test_it_flies_as_long_as_the_clock_ran():
    clock, flight, said, pace = make()
    for passed_s in (0.005, 0.007, 0.2):
        clock.advance(passed_s)
        pace.keep()
    assert flight.pieces == [0.005, 0.007, 0.2]
    assert said == []


def test_missed_time_is_skipped_and_said_not_flown():
    clock, flight, said, pace = make()
    clock.advance(3.0)
    pace.keep()
    clock.advance(0.005)
    pace.keep()
    assert flight.pieces == [0.25, 0.005]
    assert pace.skipped_s == 2.75
    assert len(said) == 1
    assert "late by 3.00 s" in said[0]


def test_it_says_so_at_most_every_5_s():
    clock, _flight, said, pace = make()
    for _ in range(10):
        clock.advance(1.0)
        pace.keep()
    assert len(said) == 2
