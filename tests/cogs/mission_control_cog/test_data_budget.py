from itertools import pairwise

import pytest
from mission_control_cog.data_budget import HOLDS_S, SLOWEST_S, USEFUL_HZ, DataBudget

COSTS = (250, 215, 190)
"""Bytes of a frame with headers and acknowledgement, by level of detail."""


def fly(limit, seconds, costs=COSTS, extra=lambda now_s: 0):
    """Return the budget and the frames of the last half as (time, level)."""
    budget, frames = DataBudget(limit, 0.0), []
    for tick in range(1, round(seconds * 10)):
        now_s, more = tick / 10, extra(tick / 10)
        budget.count(more + (costs[frames[-1][1]] if frames and frames[-1][2] else 0), now_s)
        is_sent = budget.permits(now_s)
        frames.append((now_s, budget.level, is_sent))
    return budget, [each[:2] for each in frames if each[2] and each[0] > seconds / 2]


def rate_hz(frames):
    return (len(frames) - 1) / (frames[-1][0] - frames[0][0])


def test_without_a_limit_every_frame_leaves_and_is_counted():
    budget, frames = fly(None, 120)
    assert rate_hz(frames) == pytest.approx(10, rel=0.01)
    assert budget.mb_per_hour == pytest.approx(10 * 250 * 3600 / 1e6, rel=0.02)
    assert budget.mb == pytest.approx(120 * 10 * 250 / 1e6, rel=0.01)
    assert (budget.left_out, budget.level) == (0, 0)


@pytest.mark.parametrize("limit", [9.0, 5.0, 3.0, 2.7, 1.0])
def test_the_limit_holds_and_is_used(limit):
    budget, _ = fly(limit, 600)
    spent = budget.mb / (600 / 3600)
    assert 0.93 * limit < spent <= limit
    assert budget.mb_per_hour == pytest.approx(limit, rel=0.05)


def test_first_there_are_fewer_frames_then_less_detail():
    _, frames = fly(5.0, 120)
    assert {level for _, level in frames} == {0}
    assert rate_hz(frames) > USEFUL_HZ
    _, frames = fly(2.9, 120)
    levels = [level for _, level in frames]
    assert levels.count(1) + levels.count(2) > 0.8 * len(levels)


def test_a_connection_that_is_made_costs_no_detail():
    _, frames = fly(5.0, 60, extra=lambda now_s: 3000 if now_s < 0.15 else 0)
    budget, _ = fly(5.0, 4, extra=lambda now_s: 3000 if now_s < 0.15 else 0)
    assert budget.level == 0
    assert {level for _, level in frames} == {0}


def test_the_detail_comes_back():
    budget, _ = fly(4.5, 300, extra=lambda now_s: 300 if now_s < 100 and now_s % 1 < 0.05 else 0)
    assert budget.level == 0


def test_a_burst_of_other_data_never_silences_attitude_for_longer_than_a_second():
    _, frames = fly(1.0, 60, extra=lambda now_s: 100_000 if now_s == 31.0 else 0)
    pauses = [after[0] - before[0] for before, after in pairwise(frames)]
    assert max(pauses) <= SLOWEST_S + 0.11
    assert len(HOLDS_S) == len(COSTS)


def test_an_alarm_leaves_at_once_but_many_of_them_do_not_break_the_budget():
    budget = DataBudget(2.7, 0.0)
    budget.count(1000, 1.0)
    assert budget.permits(1.0)
    assert not budget.permits(1.1)
    assert budget.permits(1.1, is_urgent=True)
    for tick in range(12, 6000):
        now_s = tick / 10
        budget.count(250 * budget.permits(now_s, is_urgent=True), now_s)
    assert budget.mb / (600 / 3600) == pytest.approx(2.7, rel=0.05)


def test_a_link_whose_bytes_are_not_known_sends_every_frame():
    budget, frames = fly(3.0, 60, costs=(0, 0, 0))
    assert rate_hz(frames) == pytest.approx(10, rel=0.01)
    assert (budget.left_out, budget.level) == (0, 0)
