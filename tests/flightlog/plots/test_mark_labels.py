"""Labels of events: none covers another, and each is in the flight."""

import itertools

from hypothesis import given
from hypothesis import strategies as st

from up_flightlog.plots.chart import Mark
from up_flightlog.plots.mark_labels import GAP_IN, MAX_ROWS, place_labels

WIDTH_IN, SECONDS = 8.6, 40.0


def measure(text):
    """Return a width as letters of equal width have it, inches."""
    return 0.075 * len(text)


def extent(placed):
    line = placed.mark.at_s / SECONDS * WIDTH_IN
    wide = measure(placed.text) + GAP_IN
    return (line - wide, line) if placed.is_left else (line, line + wide)


MARKS = st.lists(
    st.builds(Mark, st.floats(0, SECONDS), text=st.text("abcdefgh ", min_size=1, max_size=90)),
    max_size=40,
)


@given(MARKS)
def test_no_label_covers_another_or_reaches_beyond_the_panels(marks):
    placed, left_out = place_labels(marks, SECONDS, WIDTH_IN, measure)
    assert len(placed) + left_out == len(marks)
    for one, other in itertools.combinations(placed, 2):
        if one.row == other.row:
            (low, high), (other_low, other_high) = extent(one), extent(other)
            assert high <= other_low + 1e-9 or other_high <= low + 1e-9
    for each in placed:
        assert 0 <= each.row < MAX_ROWS
        low, high = extent(each)
        wide = measure(each.text) + GAP_IN
        assert low >= -1e-9 or wide > WIDTH_IN
        assert high <= WIDTH_IN + 1e-9 or each.mark.at_s / SECONDS * WIDTH_IN <= wide


def test_one_label_needs_one_row_and_marks_outside_the_flight_need_none():
    placed, left_out = place_labels(
        [Mark(10, text="gust"), Mark(-1, text="before"), Mark(99, text="after")],
        SECONDS,
        WIDTH_IN,
        measure,
    )
    assert [(each.text, each.row) for each in placed] == [("gust", 0)]
    assert left_out == 0


def test_the_earlier_of_two_stands_higher_so_that_no_line_crosses_it():
    placed, _ = place_labels(
        [Mark(10, text="receiver lost"), Mark(10.5, text="gust")], SECONDS, WIDTH_IN, measure
    )
    assert [each.row for each in placed] == [1, 0]


def test_long_labels_are_cut():
    placed, _ = place_labels([Mark(1, text="x" * 300)], SECONDS, WIDTH_IN, measure)
    assert len(placed[0].text) == 60
    assert placed[0].text.endswith("…")
