import pytest
from twisted.internet.task import Clock

from up.log.limits import Limited, Once


class Said:
    def __init__(self):
        self.lines = []
        self.more = []

    def __call__(self, format_, **fields):
        self.lines.append(format_.format(**fields))
        self.more.append(fields.get("more", 0))


@pytest.fixture
def said():
    return Said()


@pytest.fixture
def clock():
    return Clock()


def test_once_is_once_for_each_key():
    once = Once()
    assert [once.first(key) for key in ("a", "b", "a", "b")] == [True, True, False, False]


def test_once_does_not_grow_without_bound():
    once = Once(limit=2)
    assert [once.first(key) for key in range(5)] == [True, True, False, False, False]


def test_the_first_event_is_said_at_once_and_the_rest_counted(clock, said):
    limited = Limited(clock, 10)
    for number in range(42):
        limited.log(said, "{number}", number=number)
    assert said.lines == ["0"]
    clock.advance(10)
    assert said.lines[1:] == ["41 (and 41 more in 10 s)"]


def test_while_it_goes_on_it_is_said_once_an_interval(clock, said):
    limited = Limited(clock, 10)
    for _ in range(100):
        limited.log(said, "x")
        clock.advance(1)
    assert said.more == [0, 9, *[10] * 9]


def test_after_a_quiet_interval_it_is_said_at_once_again(clock, said):
    limited = Limited(clock, 10)
    limited.log(said, "x")
    clock.advance(10)
    assert clock.getDelayedCalls() == []
    limited.log(said, "x")
    assert said.lines == ["x", "x"]


def test_keys_are_apart(clock, said):
    limited = Limited(clock, 10)
    for peer in "aabb":
        limited.log(said, "{peer}", key=peer, peer=peer)
    assert said.lines == ["a", "b"]


def test_beyond_its_limit_all_keys_share_one(clock, said):
    limited = Limited(clock, 10, limit=2)
    for peer in range(100):
        limited.log(said, "{peer}", key=peer, peer=peer)
    assert said.lines == ["0", "1", "2"]
    assert len(clock.getDelayedCalls()) == 3
    clock.advance(10)
    assert said.lines[3:] == ["99 (and 97 more in 10 s)"]


def test_stop_says_what_was_held_back_and_leaves_no_timer(clock, said):
    limited = Limited(clock, 10)
    limited.log(said, "x")
    limited.log(said, "x")
    limited.log(said, "y")
    limited.stop()
    assert said.lines == ["x", "y", "x (and 1 more in 10 s)"]
    limited.log(said, "z")
    assert said.lines[-1] == "z"
    assert clock.getDelayedCalls() == []
