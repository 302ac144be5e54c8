"""Pauses between attempts."""

import pytest

from up_ground.backoff import FIRST_S, JITTER, LONGEST_S, Backoff


def test_pauses_double_up_to_the_longest_and_begin_anew():
    backoff = Backoff(lambda: 0.0)
    pauses = [backoff.pause_s() for _ in range(6)]
    assert pauses == pytest.approx([0.2, 0.4, 0.8, 1.6, 2.0, 2.0])
    assert max(pauses) == LONGEST_S
    backoff.reset()
    assert backoff.pause_s() == FIRST_S


def test_jitter_shortens_by_a_fifth_at_most():
    assert Backoff(lambda: 1.0).pause_s() == pytest.approx(FIRST_S * (1 - JITTER))
