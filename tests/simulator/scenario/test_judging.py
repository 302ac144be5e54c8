"""Each kind of expectation: what holds, what does not, and by which figure."""

import math

import pytest

from tests.simulator.scenario.minimal import HEAD, log_of
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.result import FlightFacts, judge

TWO_S = 101


def verdict(text, columns, *, events=None, duration_s=2.0, **facts):
    head = HEAD + "events: [{at_s: 1, name: then, imu: well}]\n" if events else HEAD
    expectation = parse_scenario(f"{head}expect: [{{name: a, {text}}}]\n").expect[0]
    log = log_of(columns, TWO_S)
    return judge(expectation, FlightFacts(log, events or {}, duration_s, **facts))


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
    assert found.has_figure and found.limit


def test_words_and_flags():
    mode = {"board.mode": lambda t: "FBW" if t < 1 else "ACRO"}
    assert not verdict("signal: board.mode, is: FBW", mode).is_held
    assert verdict("signal: board.mode, is: FBW, to_s: 0.9", mode).is_held
    found = verdict("signal: board.mode, becomes: ACRO, within_s: 1.5", mode)
    assert (found.is_held, found.figure) == (True, "1.00 s")
    armed = {"board.armed": lambda t: t > 1}
    assert verdict("signal: board.armed, becomes: yes, within_s: 1.5", armed).is_held
    assert not verdict("signal: board.armed, is: true", armed).is_held


def test_of_several_wrong_values_the_most_frequent_is_told_with_its_own_share():
    mode = {"board.mode": lambda t: "" if t < 0.1 else "FBW" if t < 0.9 else "ACRO"}
    found = verdict("signal: board.mode, is: RATE, from_s: 0.5, to_s: 1.48", mode)
    assert found.figure == "ACRO for 60 % of the time, others for 40 %"
    assert found.why == "first at 0.50 s" and found.has_figure
    heights = verdict("signal: truth.roll_deg, is: 3", roll(lambda t: t))
    assert heights.figure == "0 for 1 % of the time, others for 99 %"


def test_a_window_counts_from_its_event():
    columns = {**roll(lambda t: t), "board.armed": lambda t: False}
    events = {"then": 1.0}
    text = "signal: truth.roll_deg, after: then, to_s: 0.5"
    assert verdict(f"{text}, between: [1, 1.5]", columns, events=events).is_held
    late = verdict(f"{text}, above: 0", columns, events={"other": 1.0})
    assert not late.is_held and not late.has_figure


def test_angles_go_round():
    north = {"truth.yaw_deg": lambda t: (359 + 2 * t) % 360}
    assert verdict("signal: truth.yaw_deg, stays: 4.1", north).is_held
    assert verdict("signal: truth.yaw_deg, max_step: 0.1", north).is_held
    assert not verdict("signal: truth.yaw_deg, stays: 3.9", north).is_held


def test_what_is_not_known_is_no_figure():
    unknown = roll(lambda t: math.nan if 1 < t < 1.1 else 0.0)
    for kind in ("between: [-1, 1]", "rms_below: 1", "stays: 1", "max_step: 1"):
        found = verdict(f"signal: truth.roll_deg, {kind}", unknown)
        assert not found.is_held and not found.has_figure
        assert "not known at 1.02 s" in found.why
    for kind in ("is: FBW", "is_not: ACRO", "changes_below: 0"):
        word = verdict(f"signal: board.mode, {kind}", {"board.mode": lambda t: ""})
        assert not word.is_held and not word.has_figure
    assert "never known" in word.why


def test_it_is_not_something_only_where_it_is_known_throughout():
    mode = {"board.mode": lambda t: "" if t < 0.5 else "FBW"}
    text = "signal: board.mode, is_not: ACRO"
    found = verdict(text, mode)
    assert not found.is_held and not found.has_figure
    assert verdict(f"{text}, from_s: 0.5", mode).is_held


def test_changes_are_counted_where_something_was_known():
    mode = {"board.mode": lambda t: "" if t < 0.5 else "FBW" if t < 1 else "ACRO"}
    assert verdict("signal: board.mode, changes_below: 1", mode).is_held
    assert verdict("signal: board.mode, changes_above: 1", mode).is_held
    unknown = verdict("signal: board.mode, changes_below: 0, to_s: 0.4", mode)
    assert (unknown.is_held, unknown.figure) == (False, "none")


def test_a_part_that_is_not_aboard_is_no_figure():
    found = verdict("signal: board.roll_deg, below: 3", roll(lambda t: t))
    assert not found.is_held and not found.has_figure and "not aboard" in found.why


def test_a_crash_inside_the_window_is_a_visible_failure():
    text = "signal: truth.roll_deg, below: 3"
    found = verdict(text, roll(lambda t: t), duration_s=5.0, crash_s=2.0)
    assert not found.is_held and found.has_figure and "ended at 2.00 s" in found.why
    before = verdict(f"{text}, from_s: 3", roll(lambda t: t), duration_s=5.0, crash_s=2.0)
    assert not before.is_held and before.has_figure and before.figure == "crashed at 2.00 s"
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
    slow = verdict(text + "{rise_time_s: 0.3}", columns)
    assert not slow.is_held and "rise is beyond its limit" in slow.why
    nothing = verdict(text + "{rise_time_s: 0.3}", roll(first_order(0.2)))
    assert not nothing.is_held and not nothing.has_figure and "demand.roll_deg" in nothing.why


def test_a_step_that_is_not_followed_has_no_rise_time():
    columns = {"truth.roll_deg": lambda t: math.sin(t * 9), "demand.roll_deg": lambda t: 0.0}
    text = "signal: truth.roll_deg, from_s: 0.5, step: {start: 0, end: 30, rise_time_s: 1}"
    found = verdict(text, columns)
    assert not found.is_held and "rise never" in found.figure
