from hypothesis import given
from hypothesis import strategies as st
from mission_control_cog.path_selector import (
    HEALTHY_S,
    MAX_DOUBLINGS,
    PROBE_S,
    PathSelector,
)

RETURN_AFTER_S = 10.0


def connected(now_s=0.0, count=2):
    selector = PathSelector(count, RETURN_AFTER_S)
    assert selector.next(now_s) == 0
    selector.carries(0, now_s)
    return selector


def test_without_an_answer_all_paths_are_tried_in_turn():
    selector = PathSelector(3, RETURN_AFTER_S)
    tried = []
    for now_s in range(5):
        tried.append(selector.next(now_s))
        selector.failed(tried[-1], now_s)
    assert tried == [0, 1, 2, 0, 1]


def test_a_lost_link_goes_to_the_best_healthy_path():
    selector = connected(count=3)
    selector.failed(1, 1.0)
    selector.answered(2, 1.0)
    selector.lost(2.0)
    assert selector.next(2.0) == 2


def test_an_old_answer_is_not_health():
    selector = connected()
    selector.answered(1, 1.0)
    assert selector.has_other(0, 1.0 + HEALTHY_S)
    assert not selector.has_other(0, 1.1 + HEALTHY_S)


def test_the_link_returns_after_the_better_path_was_healthy_without_a_break():
    selector = connected()
    selector.answered(1, 1.0)
    selector.lost(2.0)
    selector.carries(1, 2.0)
    for now_s in (5.0, 10.0):
        selector.answered(0, now_s)
    selector.failed(0, 12.0)
    for now_s in (15.0, 20.0, 24.9):
        selector.answered(0, now_s)
        assert not selector.has_better(now_s)
    selector.answered(0, 25.0)
    assert selector.has_better(25.0)
    assert selector.next(25.0) == 0


def returns(up_s, down_s, hours):
    """Count the returns to a better path that is up and down for these times, probed as in use."""
    selector, count = connected(), 0
    seconds = [0.5 * step for step in range(int(7200 * hours))]
    for now_s in seconds:
        is_up = now_s % (up_s + down_s) < up_s
        selector.answered(1, now_s)
        if selector.current == 0:
            if is_up:
                selector.answered(0, now_s)
            else:
                selector.lost(now_s)
                selector.carries(selector.next(now_s), now_s)
        elif now_s % PROBE_S == 0:
            (selector.answered if is_up else selector.failed)(0, now_s)
        if selector.current == 1 and selector.has_better(now_s):
            count += 1
            selector.carries(selector.next(now_s), now_s)
    return count


@given(st.integers(1, 200), st.integers(1, 200))
def test_a_path_that_comes_and_goes_is_returned_to_rarely(up_s, down_s):
    longest_s = RETURN_AFTER_S * 2**MAX_DOUBLINGS
    assert returns(up_s, down_s, 0.5) <= MAX_DOUBLINGS + 1800 / longest_s


def test_a_path_that_holds_is_returned_to_each_time():
    assert returns(400, 20, 1.0) == 8


EVENT = st.sampled_from(("answered", "failed", "lost"))


@given(st.lists(st.tuples(st.floats(0.1, 8.0), EVENT, st.integers(0, 2)), max_size=60))
def test_the_link_leaves_for_a_healthy_path_and_returns_to_a_better_one(events):
    selector, now_s = connected(count=3), 0.0
    for pause_s, event, path in events:
        now_s += pause_s
        before = selector.current
        if event == "lost":
            selector.lost(now_s)
            has_other = selector.has_other(before, now_s)
            taken = selector.next(now_s)
            assert selector.is_healthy(taken, now_s) == has_other
            assert taken != before or not has_other
            selector.carries(taken, now_s)
            continue
        getattr(selector, event)(path, now_s)
        if selector.has_better(now_s):
            taken = selector.next(now_s)
            assert taken < before
            assert selector.is_healthy(taken, now_s)
            selector.carries(taken, now_s)
