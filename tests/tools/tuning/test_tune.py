"""The search: flights with its proposals keep the rules, and every rule has an effect."""

from dataclasses import replace

import pytest

from tools.tuning.evaluation import Rules, try_loop
from tools.tuning.gain_set import AxisGains, with_axis
from tools.tuning.tune import TuneError, choose, measure_loops, tune_axis, tune_yaw
from up.commands.gains import Gains, GainSet, LoopGains
from up_simulator.harness.workers import Workers

RULES = Rules()
BEGIN = GainSet(
    LoopGains(Gains(2.0), Gains(2.0), Gains(0.5)), LoopGains(Gains(6.0), Gains(6.0), Gains(0.0))
)


@pytest.fixture(scope="module")
def roll(bench):
    with Workers() as workers:
        return tune_axis(bench, BEGIN, "roll", workers, is_quick=True)


def test_proposed_gains_keep_the_rules_when_measured(bench, roll):
    assert roll.keeps_the_rules
    gains = roll.proposal.gains
    for dives in (False, True):
        loop = try_loop(bench, with_axis(BEGIN, "roll", gains), "roll", gains, dives)
        assert RULES.broken_by_margins(loop.margins()) == []
    assert RULES.broken_by_steps(roll.proposal.steps) == []


def test_a_soft_pitch_makes_no_gentle_dive_of_it(bench, roll):
    """The nose stays up with it: the roll would be judged at a speed that is soon flown."""
    soft = with_axis(BEGIN, "pitch", AxisGains(Gains(0.6), Gains(2.0)))
    with Workers() as workers:
        cruise, dive = measure_loops(bench, soft, "roll", workers)
    assert dive.airspeed_m_s >= 1.6 * cruise.airspeed_m_s - 1e-9
    gains = roll.proposal.gains
    left_db = dive.margins(gains).gain_margin_db
    assert left_db <= roll.dive.margins(gains).gain_margin_db + 1.0


def test_it_is_the_fastest_of_those_that_were_tried_or_nearly_as_fast_and_calmer(roll):
    fastest = min(each.score for each in roll.candidates if not each.broken)
    assert roll.proposal.score <= 1.1 * fastest
    assert roll.now.gains == AxisGains(Gains(2.0), Gains(6.0))


def retune(bench, roll, rules):
    """Tune by other rules, with the loops that were measured."""
    with Workers() as workers:
        return tune_axis(
            bench,
            BEGIN,
            "roll",
            workers,
            rules=rules,
            loops=(roll.cruise, roll.dive),
            is_quick=True,
        )


def test_a_stricter_rule_gives_gentler_gains(bench, roll):
    gentle = retune(bench, roll, Rules(gain_margin_db=14.0))
    assert gentle.proposal.gains.rate.p < 0.75 * roll.proposal.gains.rate.p
    assert gentle.proposal.dive.gain_margin_db >= 14.0


def test_a_rule_without_a_solution_is_reported(bench, roll):
    with pytest.raises(TuneError) as caught:
        retune(bench, roll, Rules(gain_margin_db=200.0))
    assert caught.value.code == "no_margins"


def test_of_nearly_equals_the_calmest_is_chosen(roll):
    good = roll.proposal
    faster = replace(good, dive=replace(good.dive, peak_sensitivity=1.95))
    calmer = replace(
        good,
        dive=replace(good.dive, peak_sensitivity=1.2),
        cruise=replace(good.cruise, peak_sensitivity=1.1),
    )
    assert choose([faster, calmer]) is calmer
    broken = replace(calmer, broken=("overshoot 30 %",))
    assert choose([faster, broken]) is faster


def test_the_damper_is_the_weakest_that_halves_the_swing(bench):
    with Workers() as workers:
        yaw = tune_yaw(bench, BEGIN, workers, is_quick=True)
    swings = dict(yaw.swings)
    assert swings[yaw.proposal] <= 0.5 * swings[0.0]
    assert all(swing > 0.5 * swings[0.0] for gain, swing in swings.items() if gain < yaw.proposal)


def test_two_processes_give_the_result_of_one():
    counts = []
    with Workers(2, lambda done, asked: counts.append((done, asked))) as workers:
        assert workers.fly(divmod, [(17, 5), (9, 4), (8, 3)]) == [(3, 2), (2, 1), (2, 2)]
    assert counts == [(1, 3), (2, 3), (3, 3)]
