"""Charts over time: silences stay open, peaks stay, invalid values are not drawn."""

import math

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from up_flightlog.plots.chart import Curve, Panel, broken, drawable, thinned, usual_gap_s
from up_flightlog.plots.timeline import limits, time_text

VALUES = st.lists(st.floats(allow_infinity=True, allow_nan=True), max_size=200)


def test_a_silence_is_left_open():
    times_s = [0.0, 0.1, 0.2, 5.0, 5.1]
    found_s, found = broken(times_s, [1, 2, 3, 4, 5])
    assert found[:3] == [1, 2, 3] and math.isnan(found[3]) and found[4:] == [4, 5]
    assert found_s[3] == 0.2


def test_a_slow_source_is_not_silent_between_its_words():
    times_s = [0.0, 10.0, 20.0, 30.0, 100.0]
    assert usual_gap_s(times_s) == 60.0
    assert [math.isnan(value) for value in broken(times_s, [0] * 5)[1]] == [0, 0, 0, 0, 1, 0]
    assert not any(map(math.isnan, broken(times_s, [0] * 5, gap_s=1e9)[1]))


def test_what_no_axis_can_show_is_left_open():
    curve = Curve("x", [0, 0.1, 0.2, 0.3], [1.0, 1e300, -math.inf, 2.0], "blue")
    assert [value for value in drawable(curve)[1] if not math.isnan(value)] == [1.0, 2.0]
    assert limits(Panel("", "", [curve]))[1] < 3


@settings(deadline=None)
@example([0.0] * 9 + [math.inf, -math.inf], 10)
@given(VALUES, st.integers(10, 50))
def test_thinning_keeps_order_peaks_and_silences(values, limit):
    times_s = [float(at) for at in range(len(values))]
    found_s, found = thinned(times_s, values, limit)
    assert found_s == sorted(found_s)
    known = [value for value in values if not math.isnan(value)]
    if known:
        kept = [value for value in found if not math.isnan(value)]
        assert max(kept) == max(known) and min(kept) == min(known)
    assert any(map(math.isnan, found)) == any(map(math.isnan, values))
    assert len(found) <= max(limit, 1.5 * limit + 3)


@settings(deadline=None)
@given(st.lists(st.floats(-1e15, 1e15), min_size=1, max_size=20))
def test_an_axis_shows_every_value(values):
    panel = Panel("", "", [Curve("x", list(range(len(values))), values, "blue")])
    low, high = limits(panel)
    assert low <= min(values) and max(values) <= high and low < high


@pytest.mark.parametrize(
    ("seconds", "text"), [(0, "0:00"), (90, "1:30"), (0.5, "0.5"), (3600, "1:00:00")]
)
def test_times_on_the_axis(seconds, text):
    assert time_text(seconds) == text
