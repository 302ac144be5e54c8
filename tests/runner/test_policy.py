"""The delay before an ended instance is restarted."""

from hypothesis import given
from hypothesis import strategies as st

from up_runner.config import Restarts
from up_runner.policy import Backoff


def test_the_delay_doubles_up_to_its_bound():
    backoff = Backoff(Restarts(0.25, 2.0), gives_up=False)
    assert [backoff.next_delay_s(float(at)) for at in range(6)] == [0.25, 0.5, 1.0, 2.0, 2.0, 2.0]


def test_more_ends_than_the_limit_within_the_period_give_it_up():
    backoff = Backoff(Restarts(0.0, 1.0, 2), gives_up=True)
    assert backoff.next_delay_s(0.0) is not None
    assert backoff.next_delay_s(30.0) is not None
    assert backoff.next_delay_s(59.9) is None


def test_ends_that_are_long_ago_do_not_count():
    backoff = Backoff(Restarts(0.25, 10.0, 2), gives_up=True)
    assert [backoff.next_delay_s(60.0 * at) for at in range(100)] == [0.25] * 100


def test_a_flight_controller_is_never_given_up():
    backoff = Backoff(Restarts(), gives_up=False)
    assert {backoff.next_delay_s(0.0) for _ in range(2000)} >= {0.25, 10.0}
    assert None not in {backoff.next_delay_s(0.0) for _ in range(10)}


@given(st.lists(st.floats(0, 1000), max_size=50), st.integers(0, 5))
def test_delays_stay_within_their_bounds(gaps, limit):
    backoff, now_s = Backoff(Restarts(limit=limit), gives_up=True), 0.0
    for gap in gaps:
        now_s += gap
        delay_s = backoff.next_delay_s(now_s)
        assert delay_s is None or 0.25 <= delay_s <= 10.0
        assert (delay_s is None) == (backoff.count > limit)
