from up.system.backoff import INITIAL_DELAY_S, MAX_DELAY_S, Backoff


def test_the_distance_doubles_up_to_its_bound_and_begins_anew():
    backoff = Backoff(draw=lambda: 0.0)
    assert [backoff.pause_s(0) for _ in range(6)] == [0.3, 0.6, 1.2, 2.4, 2.4, 2.4]
    backoff.reset()
    assert backoff.pause_s(0) == INITIAL_DELAY_S


def test_the_time_of_the_attempt_counts():
    backoff = Backoff(draw=lambda: 0.0)
    for _ in range(4):
        backoff.pause_s(0)
    assert backoff.pause_s(1.0) == MAX_DELAY_S - 1.0
    assert backoff.pause_s(60) == INITIAL_DELAY_S * 0.8


def test_jitter_only_shortens():
    backoff = Backoff(draw=lambda: 1.0)
    assert abs(backoff.pause_s(0) - INITIAL_DELAY_S * 0.8) < 1e-9
