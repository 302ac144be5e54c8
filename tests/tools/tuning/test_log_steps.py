"""Steps in a log: found where a stick stepped, measured, and put into words."""

import math
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tools.tuning.log_steps import LogStepsError, advice, steps_of
from up_simulator.scenario.log import FlightLog

ROW_S = 0.02
AXES = ("roll", "pitch")


def flight(demands, *, stiffness=16.0, damping=6.0, gain=1.0, noise=0.0, name="roll_deg"):
    """Return a log in which a second-order aeroplane follows demands (one a row)."""
    dice = random.Random(5)
    log = FlightLog(["time_s", f"demand.{name}", f"truth.{name}"])
    value = speed = 0.0
    for row, demand in enumerate(demands):
        log.append(
            {
                "time_s": row * ROW_S,
                f"demand.{name}": demand,
                f"truth.{name}": value + dice.gauss(0, noise),
            }
        )
        for _ in range(10):
            asked = 0.0 if demand is None or math.isnan(demand) else gain * demand
            speed += ROW_S / 10 * (stiffness * (asked - value) - damping * speed)
            value += ROW_S / 10 * speed
    return log


def held(*levels, seconds=3.0):
    return [level for level in levels for _ in range(round(seconds / ROW_S))]


def test_every_step_is_found_and_measured():
    steps = steps_of(flight(held(0, 30, -30, 0), noise=0.1))
    assert [(step.at_s, step.start, step.end) for step in steps] == [
        (3.0, 0, 30),
        (6.0, 30, -30),
        (9.0, -30, 0),
    ]
    exact = 100 * math.exp(-math.pi * 0.75 / math.sqrt(1 - 0.75**2))
    for step in steps:
        assert (step.axis, step.mode, step.unit) == ("roll", "FBW", "deg")
        assert step.response.overshoot_percent == pytest.approx(exact, abs=1.5)
        assert step.response.settling_time_s is not None


def test_a_rate_is_a_step_of_rate():
    (step,) = steps_of(flight(held(0, 60, seconds=2), name="pitch_rate_deg_s"))
    assert (step.axis, step.mode, step.unit) == ("pitch", "RATE", "deg/s")


@pytest.mark.parametrize(
    "demands",
    [
        held(0, 4, 0),
        [min(30.0, max(0.0, row * 0.2 - 30)) for row in range(600)],
        held(*([0, 30] * 20), seconds=0.2),
        [20 * math.sin(row * ROW_S * 3) for row in range(600)],
        [math.nan] * 300,
    ],
    ids=["too small", "too slow", "too short", "never still", "not known"],
)
def test_other_moves_are_not_steps(demands):
    assert steps_of(flight(demands)) == []


def test_a_mode_that_begins_is_no_step():
    assert steps_of(flight([None] * 150 + held(30))) == []


def test_a_stick_takes_a_moment_to_get_there():
    demands = [*held(0), 6.0, 12.0, 18.0, 24.0, *held(30)]
    (step,) = steps_of(flight(demands))
    assert (step.at_s, step.start, step.end) == (3.0, 0, 30)


def test_a_step_ends_when_the_next_begins_or_after_five_seconds():
    one, other = steps_of(flight(held(0, 30, seconds=2) + held(0, seconds=20)))
    assert one.until_s - one.at_s == pytest.approx(2, abs=0.05)
    assert other.until_s - other.at_s == pytest.approx(5, abs=0.05)


def test_missing_columns_of_the_log_are_reported():
    log = FlightLog(["time_s", "truth.roll_deg"])
    with pytest.raises(LogStepsError, match=r"no demand\.\* columns"):
        steps_of(log)


def test_an_axis_without_a_demand_is_left_out():
    log = FlightLog(
        ["time_s", *(f"{part}.{axis}_deg" for part in ("demand", "truth") for axis in AXES)]
    )
    for row, demand in enumerate(held(0, 30)):
        values = {f"demand.{axis}_deg": demand for axis in AXES}
        log.append({"time_s": row * ROW_S, **values, "truth.roll_deg": row, "truth.pitch_deg": row})
    assert [step.axis for step in steps_of(log)] == ["pitch", "roll"]
    assert [step.axis for step in steps_of(log, ["roll"])] == ["roll"]


@pytest.mark.parametrize(
    ("options", "code"),
    [
        ({"damping": 0.8, "stiffness": 25.0}, "rings"),
        ({"damping": 3.6}, "overshoots"),
        ({"gain": 0.6}, "short"),
        ({"stiffness": 1.8, "damping": 2.2}, "slow"),
        ({}, "good"),
        ({"gain": -0.5}, "not_following"),
    ],
    ids=["rings", "overshoots", "short", "slow", "well", "backwards"],
)
def test_the_advice_is_that_of_the_fault(options, code):
    log = flight(held(0, 30, 0, -30, 0, seconds=4.5), **options)
    assert advice(steps_of(log)) == {("roll", "FBW"): code}


@given(st.lists(st.none() | st.floats(-200, 200), min_size=2, max_size=300))
def test_whatever_the_demand_does_gives_steps_or_none(demands):
    log = FlightLog(["time_s", "demand.roll_deg", "truth.roll_deg"])
    for row, demand in enumerate(demands):
        log.append({"time_s": row * ROW_S, "demand.roll_deg": demand, "truth.roll_deg": row * 0.1})
    for step in steps_of(log):
        assert abs(step.end - step.start) > 4
        assert step.response is not None or step.problem
