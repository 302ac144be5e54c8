from itertools import pairwise

import pytest
from arduino_cog.on_change_sender import OnChangeSender
from hypothesis import given
from hypothesis import strategies as st
from twisted.internet.task import Clock


@pytest.fixture
def clock():
    return Clock()


def make(clock, sent, leaves=lambda: True):
    def send(payload):
        if not leaves():
            return None
        sent.append((clock.seconds(), payload))
        return 0

    return OnChangeSender(clock, send)


def test_the_same_value_is_sent_once(clock):
    sent = []
    sender = make(clock, sent)
    for _ in range(50):
        sender.offer(b"a")
        clock.advance(0.05)
    assert sent == [(0.0, b"a")]


def test_what_comes_too_early_waits_and_only_the_newest(clock):
    sent = []
    sender = make(clock, sent)
    for each in (b"a", b"b", b"c"):
        sender.offer(each)
        clock.advance(0.03)
    clock.advance(0.02)
    assert sent == [(0.0, b"a"), (pytest.approx(0.1, abs=0.02), b"c")]


def test_a_value_that_changed_back_while_it_waited_is_not_sent(clock):
    sent = []
    sender = make(clock, sent)
    for each in (b"a", b"b", b"a"):
        sender.offer(each)
    clock.advance(1)
    assert sent == [(0.0, b"a")]


def test_what_did_not_leave_is_sent_with_the_next_offer(clock):
    sent, leaves = [], [False]
    sender = make(clock, sent, lambda: leaves[0])
    sender.offer(b"a")
    leaves[0] = True
    clock.advance(0.2)
    sender.offer(b"a")
    assert sent == [(0.2, b"a")]


def test_another_board_is_told_again(clock):
    sent = []
    sender = make(clock, sent)
    sender.offer(b"a")
    clock.advance(1)
    sender.reset()
    sender.offer(b"a")
    assert [payload for _, payload in sent] == [b"a", b"a"]


def test_stopping_leaves_nothing_behind(clock):
    sent = []
    sender = make(clock, sent)
    sender.offer(b"a")
    sender.offer(b"b")
    sender.stop()
    assert not clock.getDelayedCalls()


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 300)), max_size=60))
def test_never_more_than_ten_a_second_and_the_last_one_arrives(offers):
    clock, sent = Clock(), []
    sender = make(clock, sent)
    for value, wait_ms in offers:
        sender.offer(bytes((value,)))
        clock.advance(wait_ms / 1000)
    clock.advance(1)
    times = [at_s for at_s, _ in sent]
    assert all(b - a >= 0.1 - 1e-9 for a, b in pairwise(times))
    if offers:
        assert sent[-1][1] == bytes((offers[-1][0],))
