"""The figures of a step, compared with systems whose responses are known in closed form."""

import math
import random

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from up_simulator.scenario.step_response import StepError, analyse_step

STEP_S = 0.01


def second_order(damping, natural_rad_s, *, at_s=1.0, start=0.0, end=1.0, seconds=8.0, gain=1.0):
    """Return times and the exact response of a second-order system to a step."""
    times = [index * STEP_S for index in range(round(seconds / STEP_S))]
    values = []
    for time in times:
        t = max(0.0, time - at_s)
        decay = math.exp(-damping * natural_rad_s * t)
        if damping < 1:
            root = math.sqrt(1 - damping**2)
            angle = natural_rad_s * root * t
            part = 1 - decay * (math.cos(angle) + damping / root * math.sin(angle))
        elif damping == 1:
            part = 1 - decay * (1 + natural_rad_s * t)
        else:
            root = math.sqrt(damping**2 - 1)
            slow, fast = natural_rad_s * (damping - root), natural_rad_s * (damping + root)
            part = 1 - (fast * math.exp(-slow * t) - slow * math.exp(-fast * t)) / (fast - slow)
        values.append(start + gain * (end - start) * part)
    return times, values


@pytest.mark.parametrize("damping", [0.2, 0.3, 0.45, 0.6, 0.7])
@pytest.mark.parametrize(("start", "end"), [(0, 1), (10, -20), (-50, 50)])
def test_the_overshoot_is_the_one_of_the_damping(damping, start, end):
    times, values = second_order(damping, 6.0, start=start, end=end)
    exact = 100 * math.exp(-math.pi * damping / math.sqrt(1 - damping**2))
    response = analyse_step(times, values, 1.0, start, end)
    assert response.overshoot_percent == pytest.approx(exact, abs=1.0)
    assert response.steady_error == pytest.approx(0, abs=0.005 * abs(end - start))


@pytest.mark.parametrize("tau_s", [0.1, 0.3, 0.8])
def test_a_first_order_system_rises_in_2_2_and_settles_in_3_time_constants(tau_s):
    times = [index * STEP_S for index in range(1000)]
    values = [20 * (1 - math.exp(-max(0.0, time - 0.5) / tau_s)) for time in times]
    response = analyse_step(times, values, 0.5, 0, 20)
    assert response.rise_time_s == pytest.approx(math.log(9) * tau_s, rel=0.03)
    assert response.settling_time_s == pytest.approx(math.log(20) * tau_s, rel=0.03)
    assert response.overshoot_percent == pytest.approx(0, abs=0.2)
    assert response.swings == 0


def test_swings_are_counted_from_the_first_one_beyond():
    damping = 0.2
    times, values = second_order(damping, 6.0)
    extreme = math.exp(-math.pi * damping / math.sqrt(1 - damping**2))
    exact = sum(1 for number in range(1, 20) if extreme**number > 0.05)
    assert analyse_step(times, values, 1.0, 0, 1).swings == exact


def test_what_falls_short_is_told_and_the_rest_measured_by_its_own_way():
    times, values = second_order(0.45, 6.0, end=60, gain=0.6)
    response = analyse_step(times, values, 1.0, 0, 60)
    assert response.final == pytest.approx(36, rel=0.01)
    assert response.steady_error == pytest.approx(24, rel=0.01)
    assert response.steady_error_percent == pytest.approx(40, rel=0.01)
    assert response.overshoot_percent == pytest.approx(20.5, abs=1)
    assert response.settling_time_s is not None


def test_a_response_that_began_elsewhere_than_asked_is_measured_from_there():
    times, values = second_order(0.7, 6.0, start=-2, end=8)
    response = analyse_step(times, values, 1.0, 0, 10)
    assert response.begin == pytest.approx(-2, abs=0.01)
    assert response.steady_error == pytest.approx(2, abs=0.05)
    assert response.overshoot_percent == pytest.approx(4.6, abs=0.5)


def test_one_that_rings_on_has_no_settling_time():
    times = [index * STEP_S for index in range(600)]
    values = [1 - math.cos(8 * max(0.0, time - 1)) for time in times]
    response = analyse_step(times, values, 1.0, 0, 1)
    assert response.settling_time_s is None
    assert response.swings > 4
    assert response.overshoot_percent > 80


def test_one_that_has_not_arrived_has_no_settling_time():
    times = [index * STEP_S for index in range(300)]
    values = [max(0.0, time - 1) for time in times]
    assert analyse_step(times, values, 1.0, 0, 10).settling_time_s is None


def test_one_that_goes_the_other_way_did_not_rise():
    times, values = second_order(0.7, 6.0, gain=-0.5)
    response = analyse_step(times, values, 1.0, 0, 1)
    assert response.rise_time_s is None
    assert response.settling_time_s is None
    assert response.overshoot_percent == 0
    assert response.steady_error_percent == pytest.approx(150, abs=1)


def test_what_comes_after_the_end_is_not_looked_at():
    times, values = second_order(0.5, 6.0, seconds=6.0)
    back = [value if time < 4 else -5.0 for time, value in zip(times, values, strict=True)]
    cut = analyse_step(times, back, 1.0, 0, 1, until_s=3.9)
    assert cut.overshoot_percent == pytest.approx(16.3, abs=0.6)
    assert cut.settling_time_s is not None
    assert analyse_step(times, back, 1.0, 0, 1) != cut


@pytest.mark.parametrize("seed", range(5))
def test_noise_moves_the_figures_little(seed):
    dice = random.Random(seed)
    times, values = second_order(0.5, 4.0, end=30)
    noisy = [value + dice.gauss(0, 0.45) for value in values]
    clean = analyse_step(times, values, 1.0, 0, 30)
    response = analyse_step(times, noisy, 1.0, 0, 30)
    assert response.rise_time_s == pytest.approx(clean.rise_time_s, rel=0.12)
    assert response.overshoot_percent == pytest.approx(clean.overshoot_percent, abs=2.5)
    assert response.settling_time_s == pytest.approx(clean.settling_time_s, rel=0.15)
    assert response.steady_error == pytest.approx(clean.steady_error, abs=0.3)


GOOD = [index * 0.1 for index in range(40)]


@pytest.mark.parametrize(
    ("times", "values", "at", "start", "end", "code"),
    [
        (GOOD, [*GOOD[:-1], math.nan], 1, 0, 1, "not_finite"),
        (GOOD, [*GOOD[:-1], math.inf], 1, 0, 1, "not_finite"),
        ([*GOOD[:-1], 0.0], GOOD, 1, 0, 1, "times_not_rising"),
        (GOOD, GOOD, math.nan, 0, 1, "not_finite"),
        (GOOD, GOOD, 1, 2, 2, "no_step"),
        (GOOD, GOOD, 3.5, 0, 1, "too_few_samples"),
        (GOOD, GOOD, 99, 0, 1, "too_few_samples"),
        ([], [], 1, 0, 1, "too_few_samples"),
        (GOOD, [7.0] * 40, 1, 0, 1, "no_response"),
    ],
)
def test_samples_without_a_step_have_a_code(times, values, at, start, end, code):
    with pytest.raises(StepError) as raised:
        analyse_step(times, values, at, start, end)
    assert raised.value.code == code and "\n" not in str(raised.value)


NUMBERS = st.floats(allow_nan=True, allow_infinity=True, width=32)


@given(
    values=st.lists(NUMBERS, max_size=60),
    period_s=st.floats(0.001, 1.0),
    at=st.floats(-1, 3),
    start=NUMBERS,
    end=NUMBERS,
    until=st.none() | NUMBERS,
)
def test_whatever_comes_gives_figures_or_a_step_error(values, period_s, at, start, end, until):
    times = [index * period_s for index in range(len(values))]
    try:
        response = analyse_step(times, values, at, start, end, until)
    except StepError as error:
        assert "\n" not in str(error)
        return
    assert math.isfinite(response.overshoot_percent)
    assert response.overshoot_percent >= 0
    for time_s in (response.rise_time_s, response.settling_time_s):
        assert time_s is None or 0 <= time_s <= times[-1] - at + period_s


@given(
    damping=st.floats(0.15, 0.9),
    natural=st.floats(2.0, 12.0),
    start=st.floats(-100, 100),
    way=st.floats(-200, 200),
)
def test_scale_and_direction_of_the_step_change_no_figure(damping, natural, start, way):
    assume(abs(way) > 1)
    plain = analyse_step(*second_order(damping, natural), 1.0, 0, 1)
    moved = second_order(damping, natural, start=start, end=start + way)
    other = analyse_step(*moved, 1.0, start, start + way)
    assert other.overshoot_percent == pytest.approx(plain.overshoot_percent, abs=0.01)
    assert other.rise_time_s == pytest.approx(plain.rise_time_s, abs=1e-6)
    assert other.swings == plain.swings
