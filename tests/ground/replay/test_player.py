import math
from itertools import pairwise

import pytest
from twisted.internet.task import Clock

from up_flightlog.read.telemetry_frames import Frame
from up_ground.replay.player import Player


class Bench:
    def __init__(self, length_s=10.0):
        self.clock, self.shown, self.spans, self.changes = Clock(), [], [], 0
        self.player = Player(
            self.clock,
            length_s,
            lambda since_s: (
                Frame(number / 10, {"n": number})
                for number in range(round(length_s * 10) + 1)
                if number / 10 >= since_s
            ),
            show=lambda frame: self.shown.append(frame.time_s),
            moved=lambda before_s, now_s: self.spans.append((before_s, now_s)),
            changed=self.on_changed,
        )

    def on_changed(self):
        self.changes += 1

    def run(self, for_s):
        self.clock.pump([0.01] * round(for_s * 100))


@pytest.fixture
def bench():
    return Bench()


def test_nothing_moves_before_it_plays(bench):
    bench.run(5)
    assert bench.shown == []
    assert bench.player.time_s == 0


def test_frames_come_when_they_are_due(bench):
    bench.player.play()
    bench.run(0.95)
    assert bench.shown == [number / 10 for number in range(10)]
    assert bench.player.time_s == pytest.approx(0.95)


@pytest.mark.parametrize("speed", [0.25, 1.0, 4.0, 64.0])
def test_the_speed_is_the_speed(bench, speed):
    bench.player.set_speed(speed)
    bench.player.play()
    bench.run(0.1)
    assert bench.player.time_s == pytest.approx(0.1 * speed)
    # However fast it goes, no page is flooded.
    assert len(bench.shown) <= 4


@pytest.mark.parametrize("speed", [1e9, 64.1, 0.2, 0.0, -1.0, math.nan])
def test_a_speed_out_of_range_is_refused(bench, speed):
    bench.player.set_speed(2.0)
    with pytest.raises(ValueError, match=r"0\.25 to 64"):
        bench.player.set_speed(speed)
    assert bench.player.speed == 2.0


def test_a_pause_stands_still_and_goes_on_from_there(bench):
    bench.player.play()
    bench.run(2.0)
    bench.player.pause()
    shown = len(bench.shown)
    bench.run(5)
    assert bench.player.time_s == pytest.approx(2.0)
    assert len(bench.shown) == shown
    bench.player.play()
    bench.run(1.0)
    assert bench.player.time_s == pytest.approx(3.0)


def test_a_jump_shows_where_it_went(bench):
    bench.player.seek(7.25)
    assert bench.shown == [7.3]
    assert bench.player.time_s == 7.25
    bench.player.seek(-5)
    assert bench.player.time_s == 0
    bench.player.seek(1e9)
    assert bench.player.time_s == 10.0
    assert not bench.player.is_playing


def test_it_ends_at_the_end_and_begins_anew(bench):
    bench.player.play()
    bench.run(11)
    assert not bench.player.is_playing
    assert bench.player.time_s == 10.0
    assert bench.shown[-1] == 10.0
    assert bench.clock.getDelayedCalls() == []
    bench.player.play()
    bench.run(0.5)
    assert bench.player.time_s == pytest.approx(0.5)


def test_every_moment_is_passed_once(bench):
    bench.player.set_speed(16.0)
    bench.player.play()
    bench.run(2)
    assert bench.spans[0][0] == 0.0
    assert bench.spans[-1][1] == 10.0
    for (_, end_s), (begin_s, _) in pairwise(bench.spans):
        assert begin_s == end_s


def test_a_flight_without_a_frame_ends(bench):
    bench = Bench(length_s=0.0)
    bench.player.play()
    bench.run(1)
    assert not bench.player.is_playing


def test_a_frame_is_shown_again_while_it_grows_old():
    bench = Bench()
    bench.player._open_at = lambda since_s: iter([Frame(2.0, {}), Frame(8.0, {})])
    bench.player.seek(2.0)
    bench.player.play()
    bench.run(3.0)
    assert 10 <= bench.shown.count(2.0) <= 16
    assert 8.0 not in bench.shown
    bench.run(3.5)
    assert bench.shown[-1] == 8.0
