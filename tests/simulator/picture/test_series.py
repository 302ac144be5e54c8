"""What of a log is drawn: thinned without losing peaks, modes as spans, the track in metres."""

import math

from hypothesis import given
from hypothesis import strategies as st

from up_simulator.picture.series import crash_index, mode_spans, numbers, thinned, track
from up_simulator.scenario.log import FlightLog

VALUES = st.lists(st.floats(-1e6, 1e6) | st.just(math.nan), min_size=1, max_size=400)


@given(VALUES, st.integers(10, 60))
def test_thinning_keeps_the_extremes_and_the_order(values, most):
    times = [float(row) for row in range(len(values))]
    kept_s, kept = thinned(times, values, most)
    assert kept_s == sorted(set(kept_s))
    for time_s, value in zip(kept_s, kept, strict=True):
        assert value == values[int(time_s)] or math.isnan(value)
    known = [value for value in values if math.isfinite(value)]
    still = [value for value in kept if math.isfinite(value)]
    assert (min(known), max(known)) == (min(still), max(still)) if known else not still
    assert any(map(math.isnan, kept)) == any(map(math.isnan, values))


def log_of(**columns):
    rows = len(next(iter(columns.values())))
    log = FlightLog(["time_s", *(name.replace("__", ".") for name in columns)])
    for row in range(rows):
        values = {name.replace("__", "."): column[row] for name, column in columns.items()}
        log.append({"time_s": row * 1.0, **values})
    return log


def test_modes_are_spans_and_a_lost_receiver_is_its_own():
    log = log_of(
        board__mode=["", "ACRO", "ACRO", "FBW", "FBW", "FBW"], board__failsafe=[0, 0, 0, 0, 1, 1]
    )
    assert [(span.begin_s, span.end_s, span.name) for span in mode_spans(log)] == [
        (1.0, 3.0, "ACRO"),
        (3.0, 4.0, "FBW"),
        (4.0, 5.0, "FAILSAFE"),
    ]
    assert mode_spans(log_of(truth__roll_deg=[1, 2])) == []


def test_metres_are_taken_as_they_are():
    log = log_of(truth__north_m=[0, 3], truth__east_m=[0, 4])
    assert track(log) == ([0, 4], [0, 3])
    assert track(log_of(truth__roll_deg=[1])) is None


def test_a_column_without_values_is_none():
    log = log_of(truth__roll_deg=[None, None], truth__crashed=[False, True])
    assert numbers(log, "truth.roll_deg") is None
    assert numbers(log, "truth.pitch_deg") is None
    assert crash_index(log) == 1
    assert crash_index(log_of(truth__crashed=[False])) is None
