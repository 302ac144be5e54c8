"""Each kind of expectation: its figure, whether it holds, and the code of its failure."""

import math
import re

import pytest

from tests.simulator.scenario.minimal import log_of
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.flight_record import FlightRecord
from up_simulator.scenario.result import evaluate

TWO_S = 101


def verdict(text, columns, *, events=None, duration_s=2.0, may_crash=False, crash_s=None):
    head = f"title: A test\nduration_s: {duration_s:g}\nmay_crash: {str(may_crash).lower()}\n"
    event = "events: [{at_s: 1, name: then, imu: well}]\n" if events else ""
    scenario = parse_scenario(f"{head}{event}expect: [{{name: a, {text}}}]\n")
    log = log_of(columns, TWO_S)
    record = FlightRecord(scenario, log, event_times=events or {}, crash_s=crash_s)
    return evaluate(scenario.expect[0], record)


def roll(function):
    return {"truth.roll_deg": function}


@pytest.mark.parametrize(
    ("text", "function", "is_held", "figure"),
    [
        ("between: [-1, 2.1]", lambda t: t, True, "0 to 2 deg"),
        ("between: [-1, 1.9]", lambda t: t, False, "0 to 2 deg"),
        ("between: [0.1, 3]", lambda t: t, False, "0 to 2 deg"),
        ("below: 2", lambda t: t, True, "2 deg"),
        ("below: 1.99", lambda t: t, False, "2 deg"),
        ("above: -2", lambda t: -t, True, "-2 deg"),
        ("above: -1.99", lambda t: -t, False, "-2 deg"),
        ("below: 1, to_s: 1", lambda t: t, True, "1 deg"),
        ("above: 1, from_s: 1", lambda t: t, True, "1 deg"),
        ("is: 3", lambda t: 3.0, True, "3 all the time"),
        ("is: 3", lambda t: 3.0 if t < 1.5 else 4.0, False, "4 for 26 % of the time"),
        ("is_not: 3", lambda t: t * 10, False, "3 for 1 % of the time"),
        ("becomes_above: 1, within_s: 1", lambda t: t, True, "1.00 s"),
        ("becomes_above: 1, within_s: 0.9", lambda t: t, False, "1.00 s"),
        ("becomes_above: 1, within_s: 0.5, from_s: 0.5", lambda t: t, True, "0.50 s"),
        ("becomes_below: -3, within_s: 2", lambda t: t, False, "never (2 at the end)"),
        ("settles_between: [-1, 1], within_s: 1.1", lambda t: 2 - t, True, "1.00 s"),
        ("settles_between: [-1, 1], within_s: 0.9", lambda t: 2 - t, False, "1.00 s"),
        ("settles_between: [-1, 1], within_s: 1", lambda t: t, False, "never (2 at the end)"),
        ("rms_below: 3", lambda t: 3.0 if t < 1 else -3.0, True, "3 deg"),
        ("rms_below: 2.9", lambda t: 3.0, False, "3 deg"),
        ("mean_between: [0.9, 1.1]", lambda t: t, True, "1 deg"),
        ("mean_between: [1.1, 1.2]", lambda t: t, False, "1 deg"),
        ("max_step: 5", lambda t: 0.0 if t < 1 else 5.0, True, "5 deg"),
        ("max_step: 4.9", lambda t: 0.0 if t < 1 else 5.0, False, "5 deg"),
        ("stays: 2", lambda t: 10 - t, True, "2 deg"),
        ("stays: 1.9", lambda t: 10 - t, False, "2 deg"),
        ("grows_below: 2", lambda t: 5 + t, True, "2 deg"),
        ("grows_above: 2.1", lambda t: 5 + t, False, "2 deg"),
        ("changes_below: 1", lambda t: float(t > 1), True, "once"),
        ("changes_below: 0", lambda t: float(t > 1), False, "once"),
        ("changes_above: 2", lambda t: float(0.5 < t < 1), True, "2 times"),
    ],
)  # fmt: skip
def test_a_figure_and_whether_it_holds(text, function, is_held, figure):
    found = verdict(f"signal: truth.roll_deg, {text}", roll(function))
    assert (found.is_held, found.figure) == (is_held, figure)
    assert found.has_figure and found.limit and bool(found.code) is not is_held


def test_text_and_flags():
    mode = {"board.mode": lambda t: "FBW" if t < 1 else "ACRO"}
    assert verdict("signal: board.mode, is: FBW", mode).code == "out_of_limits"
    assert verdict("signal: board.mode, is: FBW, to_s: 0.9", mode).is_held
    found = verdict("signal: board.mode, becomes: ACRO, within_s: 1.5", mode)
    assert (found.is_held, found.figure) == (True, "1.00 s")
    assert verdict("signal: board.mode, becomes: ACRO, within_s: 0.5", mode).code == "too_late"
    assert verdict("signal: board.mode, becomes: RATE, within_s: 1", mode).code == "never"
    armed = {"board.armed": lambda t: t > 1}
    assert verdict("signal: board.armed, becomes: yes, within_s: 1.5", armed).is_held
    assert not verdict("signal: board.armed, is: true", armed).is_held


def test_the_figure_is_the_most_frequent_wrong_value_with_its_share():
    mode = {"board.mode": lambda t: "" if t < 0.1 else "FBW" if t < 0.9 else "ACRO"}
    found = verdict("signal: board.mode, is: RATE, from_s: 0.5, to_s: 1.48", mode)
    assert re.findall("[A-Z]+|[0-9]+", found.figure) == ["ACRO", "60", "40"]
    assert found.has_figure and found.code == "out_of_limits"


def test_a_window_counts_from_its_event():
    columns = {**roll(lambda t: t), "board.armed": lambda t: False}
    events = {"then": 1.0}
    text = "signal: truth.roll_deg, after: then, to_s: 0.5"
    assert verdict(f"{text}, between: [1, 1.5]", columns, events=events).is_held
    late = verdict(f"{text}, above: 0", columns, events={"other": 1.0})
    assert (late.is_held, late.has_figure, late.code) == (False, False, "event_missing")


def test_angles_wrap():
    north = {"truth.yaw_deg": lambda t: (359 + 2 * t) % 360}
    assert verdict("signal: truth.yaw_deg, stays: 4.1", north).is_held
    assert verdict("signal: truth.yaw_deg, max_step: 0.1", north).is_held
    assert not verdict("signal: truth.yaw_deg, stays: 3.9", north).is_held


UNKNOWN_ROLL = roll(lambda t: math.nan if 1 < t < 1.1 else 0.0)


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("signal: truth.roll_deg, between: [-1, 1]", UNKNOWN_ROLL),
        ("signal: truth.roll_deg, rms_below: 1", UNKNOWN_ROLL),
        ("signal: truth.roll_deg, stays: 1", UNKNOWN_ROLL),
        ("signal: truth.roll_deg, max_step: 1", UNKNOWN_ROLL),
        ("signal: board.mode, is: FBW", {"board.mode": lambda t: ""}),
        ("signal: board.mode, is_not: ACRO", {"board.mode": lambda t: "" if t < 0.5 else "FBW"}),
        ("signal: board.mode, changes_below: 0", {"board.mode": lambda t: ""}),
    ],
)
def test_an_unknown_value_is_not_a_figure(text, columns):
    found = verdict(text, columns)
    assert (found.is_held, found.has_figure, found.code) == (False, False, "not_known")


def test_changes_are_counted_between_known_values():
    mode = {"board.mode": lambda t: "" if t < 0.5 else "FBW" if t < 1 else "ACRO"}
    assert verdict("signal: board.mode, changes_below: 1", mode).is_held
    assert verdict("signal: board.mode, changes_above: 1", mode).is_held
    assert verdict("signal: board.mode, is_not: RTH, from_s: 0.5", mode).is_held


def test_a_missing_participant_is_not_a_figure():
    found = verdict("signal: board.roll_deg, below: 3", roll(lambda t: t))
    assert (found.is_held, found.has_figure, found.code) == (False, False, "no_signal")


def test_a_crash_inside_the_window_is_a_visible_failure():
    text = "signal: truth.roll_deg, below: 3"
    found = verdict(text, roll(lambda t: t), duration_s=5.0, crash_s=2.0)
    assert (found.is_held, found.has_figure, found.code) == (False, True, "flight_ended")
    before = verdict(f"{text}, from_s: 3", roll(lambda t: t), duration_s=5.0, crash_s=2.0)
    assert (before.has_figure, before.code) == (True, "crashed")
    assert verdict(text, roll(lambda t: t), duration_s=5.0, crash_s=2.0, may_crash=True).is_held


def first_order(time_constant_s, at_s=0.5, height=10.0):
    return lambda t: height * (1 - math.exp(-(t - at_s) / time_constant_s)) if t > at_s else 0.0


def test_a_step_is_measured_against_its_demand():
    columns = {
        "truth.roll_deg": first_order(0.2),
        "demand.roll_deg": lambda t: 10.0 if t >= 0.5 else 0.0,
    }
    text = "signal: truth.roll_deg, from_s: 0.5, step: "
    held = verdict(text + "{rise_time_s: 0.5, overshoot_percent: 5, steady_error: 0.5}", columns)
    assert held.is_held
    # 10 to 90 % of a first order lag takes ln 9 time constants.
    rise_s = float(held.figure.split()[1])
    assert abs(rise_s - math.log(9) * 0.2) < 0.03
    assert verdict(text + "{rise_time_s: 0.3}", columns).code == "out_of_limits"
    nothing = verdict(text + "{rise_time_s: 0.3}", roll(first_order(0.2)))
    assert (nothing.has_figure, nothing.code) == (False, "no_step")


def test_a_step_that_is_not_followed_has_no_rise_time():
    columns = {"truth.roll_deg": lambda t: math.sin(t * 9), "demand.roll_deg": lambda t: 0.0}
    text = "signal: truth.roll_deg, from_s: 0.5, step: {start: 0, end: 30, rise_time_s: 1}"
    found = verdict(text, columns)
    assert not found.is_held and "rise never" in found.figure
