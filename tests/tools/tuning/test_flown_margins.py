"""The measured margins are those of the flight: beyond them it rings, short of them it does not."""

import math
from statistics import fmean

import pytest

from tests.tools.tuning.gains import FIRM
from tools.tuning.evaluation import try_loop
from tools.tuning.experiments import measure_loop
from tools.tuning.gain_set import (
    AxisGains,
    axis_gains,
    with_axis,
)
from tools.tuning.margins import margins_of
from tools.tuning.trial import StickMove
from up.commands.gains import Gains

GAINS = FIRM
RINGS_DEG_S, CALM_DEG_S = 5.0, 1.0


@pytest.fixture(scope="module")
def roll(bench):
    return try_loop(bench, GAINS, "roll", axis_gains(GAINS, "roll"), dives=False)


def swing_deg_s(bench, factor=1.0, delay_s=0.0):
    """Return the roll rate, rms, that is left of a short kick of the stick 2 s after it."""
    trial = bench.trial(GAINS)
    trial.fly(3.0)
    trial.dynamics.factors = {"roll": factor}
    trial.dynamics.delay_s = delay_s
    kick = [StickMove(3.1, "ailerons", 1600.0), StickMove(3.3, "ailerons", 1500.0)]
    recording = trial.fly(3.3, kick)
    rates = recording["truth.roll_rate_deg_s"][200:]
    mean = fmean(rates)
    return math.sqrt(fmean([(rate - mean) ** 2 for rate in rates]))


def test_beyond_the_gain_margin_it_rings_and_short_of_it_it_does_not(bench, roll):
    left_db = roll.margins().gain_margin_db
    assert swing_deg_s(bench, 10 ** ((left_db - 1.5) / 20)) < CALM_DEG_S
    assert swing_deg_s(bench, 10 ** ((left_db + 1.5) / 20)) > RINGS_DEG_S


def test_beyond_the_delay_margin_it_rings_and_short_of_it_it_does_not(bench, roll):
    left_s = roll.margins().delay_margin_ms / 1000
    assert swing_deg_s(bench, delay_s=0.7 * left_s) < CALM_DEG_S
    assert swing_deg_s(bench, delay_s=1.2 * left_s) > RINGS_DEG_S


def test_the_margins_of_other_gains_are_known_without_flying_them(bench, roll):
    other = AxisGains(Gains(3.5), Gains(5.0))
    flown = try_loop(bench, with_axis(GAINS, "roll", other), "roll", other, dives=False)
    expected, found = roll.margins(other), flown.margins()
    assert found.gain_margin_db == pytest.approx(expected.gain_margin_db, abs=0.8)
    assert found.peak_sensitivity == pytest.approx(expected.peak_sensitivity, abs=0.06)
    assert found.crossover_hz == pytest.approx(expected.crossover_hz, rel=0.3)


def test_a_delay_costs_its_own_time_and_a_dive_costs_gain(bench, roll):
    late = margins_of(measure_loop(bench, GAINS, "roll", periods=3, delay_s=0.02)[0])
    left_ms = roll.margins().delay_margin_ms
    assert late.delay_margin_ms == pytest.approx(left_ms - 20, abs=5)
    fast = try_loop(bench, GAINS, "roll", axis_gains(GAINS, "roll"), dives=True)
    faster_db = 40 * math.log10(fast.airspeed_m_s / roll.airspeed_m_s)
    lost_db = roll.margins().gain_margin_db - fast.margins().gain_margin_db
    assert fast.airspeed_m_s > 1.3 * roll.airspeed_m_s
    assert 0.4 * faster_db < lost_db < 1.1 * faster_db
