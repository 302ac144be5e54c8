import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.scenario.minimal import scenario
from up_simulator.scenario.sticks import StickPoint, StickTimeline

SWITCH = {"low": "ACRO", "middle": "FBW", "high": "AUTO"}


def timeline(text, switch=None):
    return StickTimeline(scenario(f"sticks: {text}\n").sticks, switch or SWITCH)


def test_before_the_first_point_sticks_are_centred_and_switches_low():
    at_rest = timeline("[]").pulses_us(0.0)
    assert at_rest == {
        "ailerons": 1500, "elevator": 1500, "throttle": 1000, "rudder": 1500,
        "aux1": 1000, "aux2": 1000,
    }  # fmt: skip


def test_fractions_modes_and_pulses_become_pulses():
    at = timeline(
        "[{at_s: 0, ailerons: -0.5, elevator: 1, throttle: 0.25, rudder_us: 1600, mode: auto,"
        " arm: true}]"
    ).pulses_us(0.0)
    assert at == {
        "ailerons": 1250, "elevator": 2000, "throttle": 1250, "rudder": 1600,
        "aux1": 2000, "aux2": 2000,
    }  # fmt: skip


def test_a_mode_selects_its_switch_position():
    with_rate = {"low": "ACRO", "middle": "RATE", "high": "FBW"}
    text = "switch: {middle: RATE, high: FBW}\nsticks: [{at_s: 0, mode: RATE}]\n"
    line = StickTimeline(scenario(text).sticks, with_rate)
    assert line.pulse_us("aux1", 0.0) == 1500
    with pytest.raises(KeyError):
        timeline("[{at_s: 0, mode: FBW}]", {"low": "ACRO"})


def test_a_stick_moves_at_constant_speed():
    line = timeline("[{at_s: 1, ailerons: 1, over_s: 2}, {at_s: 4, ailerons: 0}]")
    assert [line.pulse_us("ailerons", at) for at in (0, 1, 1.5, 2, 3, 3.9, 4, 9)] == [
        1500, 1500, 1625, 1750, 2000, 2000, 1500, 1500,
    ]  # fmt: skip


def test_a_move_continues_from_an_unfinished_one():
    line = timeline("[{at_s: 0, rudder: 1, over_s: 2}, {at_s: 1, rudder: 0, over_s: 1}]")
    assert [line.pulse_us("rudder", at) for at in (1, 1.5, 2, 3)] == [1750, 1625, 1500, 1500]


def test_points_may_be_in_any_order():
    one = timeline("[{at_s: 2, elevator: 1}, {at_s: 1, elevator: -1}]")
    assert [one.pulse_us("elevator", at) for at in (0, 1, 2)] == [1500, 1000, 2000]


@given(
    points=st.lists(
        st.builds(
            StickPoint,
            at_s=st.integers(0, 12).map(lambda tenths: tenths / 10),
            over_s=st.sampled_from((0.0, 0.3, 1.0)),
            ailerons=st.sampled_from((-1.0, 0.5)),
        ),
        max_size=5,
    )
)
def test_the_pulses_are_still_until_the_time_that_it_names(points):
    line = StickTimeline(tuple(points), SWITCH)
    until_s, shown = 0.0, {}
    for step in range(1000):
        time_s = step * 0.004
        if time_s >= until_s:
            until_s, shown = line.still_until_s(time_s), line.pulses_us(time_s)
        assert line.pulses_us(time_s) == shown
