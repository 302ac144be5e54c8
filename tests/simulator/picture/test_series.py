"""What of a log is drawn: modes as bands, the track in metres."""

from up_simulator.picture.series import crash_index, mode_bands, numbers, track
from up_simulator.scenario.log import FlightLog


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
    assert [(span.begin_s, span.end_s, span.name) for span in mode_bands(log)] == [
        (1.0, 3.0, "ACRO"),
        (3.0, 4.0, "FBW"),
        (4.0, 5.0, "failsafe"),
    ]
    assert mode_bands(log_of(truth__roll_deg=[1, 2])) == []


def test_metres_are_taken_as_they_are():
    path = track(log_of(truth__north_m=[0, 3], truth__east_m=[0, 4]))
    assert (path.times_s, path.east_m, path.north_m) == ([0, 1], [0, 4], [0, 3])
    assert track(log_of(truth__roll_deg=[1])) is None


def test_a_column_without_values_is_none():
    log = log_of(truth__roll_deg=[None, None], truth__crashed=[False, True])
    assert numbers(log, "truth.roll_deg") is None
    assert numbers(log, "truth.pitch_deg") is None
    assert crash_index(log) == 1
    assert crash_index(log_of(truth__crashed=[False])) is None
