import math
from array import array

from hypothesis import given, settings
from hypothesis import strategies as st

from up_flightlog.columns.column import Column, levels_of


def column(times_s, values, gap_s=1e9):
    values = array("f", values)
    return Column("t.x", "m", gap_s, array("d", times_s), values, list(levels_of(values)))


VALUES = st.lists(st.floats(-1e6, 1e6, width=32), min_size=1, max_size=1500)


@settings(deadline=None)
@given(VALUES, st.data())
def test_the_extremes_are_those_of_the_values(values, data):
    begin = data.draw(st.integers(0, len(values) - 1))
    end = data.draw(st.integers(begin + 1, len(values)))
    found = column(range(len(values)), values).extremes(begin, end)
    assert found == (min(values[begin:end]), max(values[begin:end]))


@settings(deadline=None)
@given(VALUES, st.integers(1, 300))
def test_a_window_has_two_points_a_pixel_and_every_extreme(values, pixels):
    found = column(range(len(values)), values).window(0, len(values), pixels)
    assert len(found.values) <= 2 * pixels
    assert (min(found.values), max(found.values)) == (min(values), max(values))
    assert list(found.times_s) == sorted(found.times_s)


def test_a_silence_is_a_gap_near_and_far():
    times_s = [*range(100), *range(200, 300)]
    made = column(times_s, [1.0] * 200, gap_s=2.0)
    for pixels in (30, 300):
        found = made.window(0, 300, pixels)
        (at,) = [at for at, value in enumerate(found.values) if math.isnan(value)]
        assert (found.times_s[at - 1], found.times_s[at], found.times_s[at + 1]) == (99, 149.5, 200)
    assert math.isnan(made.at(150)) and made.at(101) == 1.0 and math.isnan(made.at(-1))


def test_a_window_has_the_neighbours_of_its_span_and_samples_do_not():
    made = column(range(10), range(10))
    assert list(made.window(2.5, 4.5, 100).values) == [2, 3, 4, 5]
    assert list(made.samples(2.5, 9, 3).values) == [3, 4, 5]
