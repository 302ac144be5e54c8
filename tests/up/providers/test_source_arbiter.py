import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.providers.source_arbiter import RETURN_AFTER_S, SourceArbiter

PHONE, BOARD = ("android", 0), ("arduino", 10)


class Rig:
    """An arbiter and its switches."""

    def __init__(self):
        self.switches = []
        self.arbiter = SourceArbiter(0.5, lambda a, b: self.switches.append((a, b)))

    def feed(self, source, *times):
        return [self.arbiter.accepts(*source, time_s) for time_s in times]


@pytest.fixture
def rig():
    return Rig()


def tenths(start, end):
    return [tenth / 10 for tenth in range(start, end)]


def test_the_first_source_is_taken_at_once(rig):
    assert rig.feed(PHONE, 0.0) == [True]
    assert rig.switches == [("", "android")]


def test_a_better_source_needs_a_second_of_good_data(rig):
    for time_s in tenths(0, 15):
        rig.feed(PHONE, time_s)
        (taken,) = rig.feed(BOARD, time_s)
        assert taken == (time_s >= RETURN_AFTER_S)
    assert rig.switches == [("", "android"), ("android", "arduino")]
    assert rig.feed(PHONE, 1.5) == [False]


def test_the_lesser_takes_over_when_the_better_is_silent_and_back_after_a_second(rig):
    rig.feed(BOARD, 0.0)
    assert rig.feed(PHONE, 0.1, 0.4) == [False, False]
    assert rig.feed(PHONE, 0.51) == [True]
    assert rig.feed(BOARD, 0.6) == [False]
    for time_s in tenths(7, 16):
        rig.feed(PHONE, time_s)
        assert rig.feed(BOARD, time_s) == [False]
    assert rig.feed(BOARD, 1.6) == [True]
    assert rig.switches[-1] == ("android", "arduino")


def test_a_gap_in_the_better_one_begins_its_second_anew(rig):
    rig.feed(PHONE, 0.0)
    for time_s in tenths(1, 10):
        rig.feed(PHONE, time_s)
        rig.feed(BOARD, time_s)
    for time_s in tenths(10, 16):
        rig.feed(PHONE, time_s)
    assert rig.feed(BOARD, 1.6) == [False]
    for time_s in tenths(17, 26):
        rig.feed(PHONE, time_s)
        assert rig.feed(BOARD, time_s) == [False]
    assert rig.feed(BOARD, 2.6) == [True]


def test_invalid_data_begin_the_second_anew(rig):
    rig.feed(PHONE, 0.0)
    for time_s in tenths(1, 10):
        rig.feed(PHONE, time_s)
        rig.feed(BOARD, time_s)
    rig.arbiter.note_invalid("arduino", 1.0)
    rig.arbiter.note_invalid("unheard of", 1.0)
    for time_s in tenths(11, 20):
        rig.feed(PHONE, time_s)
        assert rig.feed(BOARD, time_s) == [False]
    assert rig.feed(BOARD, 2.0) == [True]


def test_equals_do_not_take_turns(rig):
    rig.feed(("a", 5), 0.0)
    for time_s in tenths(0, 50):
        assert rig.feed(("a", 5), time_s) == [True]
        assert rig.feed(("b", 5), time_s) == [False]
    assert len(rig.switches) == 1


def test_of_two_that_could_take_over_the_better_does(rig):
    best, middle, least = ("best", 3), ("middle", 2), ("least", 1)
    for time_s in tenths(0, 15):
        rig.feed(best, time_s)
        rig.feed(middle, time_s)
        rig.feed(least, time_s)
    assert rig.feed(middle, 1.85) == [False]
    assert rig.feed(least, 1.95) == [False]
    assert rig.feed(middle, 2.0) == [True]


SOURCES = [("low", 0), ("middle", 1), ("high", 2)]


@given(st.lists(st.tuples(st.sampled_from(SOURCES), st.floats(0, 1)), min_size=1, max_size=200))
def test_whatever_comes_one_source_is_followed_and_switches_are_rare(events):
    rig, now_s, newest_s = Rig(), 0.0, {}
    for source, gap_s in events:
        now_s += gap_s
        previous = rig.arbiter.current
        (taken,) = rig.feed(source, now_s)
        assert taken == (rig.arbiter.current == source[0])
        if taken and previous not in ("", source[0]):
            priorities = dict(SOURCES)
            stale = now_s - newest_s[previous] > 0.5
            assert stale or priorities[source[0]] > priorities[previous]
        newest_s[source[0]] = now_s
    assert rig.arbiter.current
