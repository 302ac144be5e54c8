import itertools

from hypothesis import given
from hypothesis import strategies as st
from load_guard_cog.modules.load_guard import PanicSwitch


def run(loads, interval_s=0.5, dwell_s=5.0):
    switch = PanicSwitch(80, 65, dwell_s)
    return switch, [
        place * interval_s
        for place, load in enumerate(loads)
        if switch.update(load, place * interval_s)
    ]


def test_a_lasting_load_switches_on_once():
    switch, switches = run([100] * 40)
    assert switch.is_on
    assert len(switches) == 1


def test_one_spike_is_smoothed_away():
    switch, switches = run([10, 10, 100, 10, 10, 10, 10])
    assert not switch.is_on
    assert switches == []


def test_between_the_thresholds_nothing_changes():
    switch, switches = run([100] * 20 + [70] * 100)
    assert switch.is_on
    assert len(switches) == 1


def test_an_oscillating_load_switches_at_most_twelve_times_a_minute():
    loads = ([100] * 6 + [0] * 6) * 10
    _, switches = run(loads)
    assert len(switches) >= 2
    assert len(switches) <= 12


@given(st.lists(st.floats(0, 100), max_size=300))
def test_switches_keep_the_dwell_time_whatever_the_load(loads):
    _, switches = run(loads)
    assert all(b - a >= 5.0 for a, b in itertools.pairwise(switches))
