"""Margins, compared with loops whose margins are known in closed form."""

import cmath
import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tools.tuning.margins import (
    LoopPoint,
    MarginsError,
    Multisine,
    loop_response,
    margins_of,
    scaled,
)

STEP_S = 0.002


def loop(transfer, low_hz=0.05, high_hz=30.0, count=60):
    """Return the points of a loop that is given as a function of s."""
    hz = [low_hz * (high_hz / low_hz) ** (at / (count - 1)) for at in range(count)]
    return [LoopPoint(each, transfer(2j * math.pi * each)) for each in hz]


@pytest.mark.parametrize(("gain", "delay_s"), [(4.0, 0.05), (10.0, 0.02), (2.0, 0.3)])
def test_an_integrator_with_a_delay(gain, delay_s):
    margins = margins_of(loop(lambda s: gain / s * cmath.exp(-s * delay_s)))
    assert margins.gain_margin_db == pytest.approx(
        20 * math.log10(math.pi / (2 * gain * delay_s)), abs=0.1
    )
    assert margins.gain_margin_hz == pytest.approx(1 / (4 * delay_s), rel=0.02)
    assert margins.crossover_hz == pytest.approx(gain / (2 * math.pi), rel=0.02)
    assert margins.phase_margin_deg == pytest.approx(90 - math.degrees(gain * delay_s), abs=0.5)
    left_ms = 1000 * (math.pi / 2 / gain - delay_s)
    assert margins.delay_margin_ms == pytest.approx(left_ms, rel=0.03)


@given(st.floats(0.5, 30), st.floats(0.5, 30), st.floats(0.05, 0.9))
def test_three_lags(first, second, share):
    """K / (s (s + a) (s + b)) rings at K = a b (a + b), with the root of a b."""
    rings_at = first * second * (first + second)
    gain = share * rings_at
    margins = margins_of(loop(lambda s: gain / (s * (s + first) * (s + second))))
    assert margins.gain_margin_db == pytest.approx(-20 * math.log10(share), abs=0.15)
    rings_hz = math.sqrt(first * second) / 2 / math.pi
    assert margins.gain_margin_hz == pytest.approx(rings_hz, rel=0.05)


def test_the_gain_that_is_too_high_is_a_margin_below_zero():
    points = loop(lambda s: 8 / s * cmath.exp(-s * 0.1))
    left = margins_of(points).gain_margin_db
    margins = margins_of(scaled(points, 4))
    assert margins.delay_margin_ms == 0
    assert margins.gain_margin_db == pytest.approx(left - 20 * math.log10(4), abs=0.2)


def test_a_loop_that_never_reaches_one_has_no_end_to_its_phase():
    margins = margins_of(loop(lambda s: 0.4 / (1 + 0.2 * s)))
    assert margins.phase_margin_deg is None
    assert margins.delay_margin_ms is None
    assert margins.gain_margin_db is None
    assert margins.peak_sensitivity < 1.05


def test_the_peak_of_the_sensitivity_is_how_near_it_comes_to_minus_one():
    points = loop(lambda s: 9 / s * cmath.exp(-s * 0.08), count=2000)
    exact = max(1 / abs(1 + point.response) for point in points)
    few = margins_of(loop(lambda s: 9 / s * cmath.exp(-s * 0.08), count=32))
    assert few.peak_sensitivity == pytest.approx(exact, rel=0.03)


def test_whole_turns_of_the_phase_do_not_matter():
    """A second integrator at low frequencies begins beyond -180 degrees, which is not ringing."""
    margins = margins_of(loop(lambda s: 6 * (s + 1) * (s + 0.4) / s**3 * cmath.exp(-s * 0.03)))
    assert margins.gain_margin_db > 10
    assert margins.phase_margin_deg > 0


@pytest.mark.parametrize("gain", [3.0, 8.0])
def test_a_loop_is_measured_while_it_is_closed(gain):
    """An integrator behind a delay, held by a proportional controller that has noise."""
    dice = random.Random(4)
    delay_steps, multisine = 20, Multisine()
    position, given, moved, waiting = 0.0, [], [], [0.0] * delay_steps
    for step in range(round(4 * multisine.period_s / STEP_S)):
        waiting.append(position + dice.gauss(0, 0.3))
        by_controller = -gain * waiting.pop(0)
        at_servo = by_controller + multisine.at(step * STEP_S)
        given.append(by_controller)
        moved.append(at_servo)
        position += at_servo * STEP_S
    points = loop_response(given, moved, multisine, STEP_S)
    margins = margins_of(points)
    delay_s = (delay_steps + 0.5) * STEP_S
    assert margins.crossover_hz == pytest.approx(gain / 2 / math.pi, rel=0.05)
    assert margins.phase_margin_deg == pytest.approx(90 - math.degrees(gain * delay_s), abs=3)
    exact_db = 20 * math.log10(math.pi / 2 / gain / delay_s)
    assert margins.gain_margin_db == pytest.approx(exact_db, abs=0.6)


def test_an_oscillating_loop_is_not_measured():
    multisine = Multisine()
    count = round(4 * multisine.period_s / STEP_S)
    moved = [
        multisine.at(at * STEP_S) + 300 * math.sin(2 * math.pi * 9.0625 * at * STEP_S)
        for at in range(count)
    ]
    with pytest.raises(MarginsError) as caught:
        loop_response([-each for each in moved], moved, multisine, STEP_S)
    assert caught.value.code == "oscillates"


def test_an_axis_without_gains_is_reported():
    multisine = Multisine()
    moved = [multisine.at(at * STEP_S) for at in range(round(4 * multisine.period_s / STEP_S))]
    with pytest.raises(MarginsError) as caught:
        loop_response([0.0] * len(moved), moved, multisine, STEP_S)
    assert caught.value.code == "no_response"


def test_too_little_is_refused():
    multisine = Multisine()
    moved = [multisine.at(at * STEP_S) for at in range(round(2 * multisine.period_s / STEP_S))]
    with pytest.raises(MarginsError) as caught:
        loop_response(moved, moved, multisine, STEP_S)
    assert caught.value.code == "too_short"
    with pytest.raises(MarginsError) as caught:
        margins_of([LoopPoint(1, 1j), LoopPoint(2, 1j), LoopPoint(3, 1j)])
    assert caught.value.code == "too_few_points"


def test_the_excitation_is_small_and_the_same_each_period():
    multisine = Multisine()
    most = max(abs(multisine.at(at * STEP_S)) for at in range(4000))
    count = len(multisine.cycles)
    assert most < 0.75 * count * multisine.amplitude_us
    assert multisine.at(1.234) == pytest.approx(multisine.at(1.234 + 3 * multisine.period_s))
