import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.scenario.log import FlightLog, LogError, read_log

COLUMNS = ["time_s", "truth.roll_deg", "board.mode", "board.armed", "event"]
TEXTS = st.text(st.characters(exclude_characters="\r\n\0", exclude_categories=["Cs"]), max_size=12)


@given(st.lists(st.tuples(st.floats(), st.one_of(st.none(), TEXTS), st.booleans(), TEXTS)))
def test_a_log_is_read_as_it_was_written(tmp_path_factory, rows):
    log = FlightLog(COLUMNS)
    for at, (roll, mode, is_armed, event) in enumerate(rows):
        log.append(
            {
                "time_s": at * 0.02,
                "truth.roll_deg": None if math.isinf(roll) else roll,
                "board.mode": mode,
                "board.armed": is_armed,
                "event": event,
            }
        )
    path = tmp_path_factory.mktemp("log") / "log.csv"
    log.write(path)
    read = read_log(path)
    assert read.columns == log.columns
    # NaN is not itself: the text is.
    again = path.with_name("again.csv")
    read.write(again)
    assert again.read_bytes() == path.read_bytes()
    assert len(read) == len(rows)


def test_columns_are_numbers_flags_and_texts():
    log = FlightLog(COLUMNS)
    log.append({"time_s": 0, "board.mode": "FBW", "board.armed": True, "event": "a; b"})
    assert log.column("board.mode") == ["FBW"] and log.has_text("board.mode")
    assert log.numbers("board.armed") == [1.0]
    assert math.isnan(log.numbers("truth.roll_deg")[0])
    assert log.events == [(0.0, "a"), (0.0, "b")]
    with pytest.raises(TypeError):
        log.numbers("board.mode")
    with pytest.raises(KeyError):
        log.column("board.mod")


def test_a_text_in_a_column_of_numbers_is_unknown():
    log = FlightLog(COLUMNS)
    log.append({"time_s": 0, "truth.roll_deg": "far"})
    assert math.isnan(log.numbers("truth.roll_deg")[0])


@pytest.mark.parametrize(
    ("text", "line", "code"),
    [
        ("", 1, "not_a_log"),
        ("a,b\n1,2\n", 1, "not_a_log"),
        ("time_s,a,a\n", 1, "duplicate_column"),
        ("time_s,truth.roll_deg\n0,1\n0.02\n", 3, "row_length"),
        ("time_s,truth.roll_deg\n0,x\n", 2, "not_a_number"),
        ("time_s\n0\n\xff\xfe", 0, "not_a_log"),
    ],
)
def test_a_file_that_is_not_a_log_is_rejected(tmp_path, text, line, code):
    path = tmp_path / "log.csv"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(LogError) as caught:
        read_log(path)
    assert caught.value.code == code and "\n" not in str(caught.value)
    assert str(caught.value).startswith(f"{path}:{line}: " if line else f"{path}: ")


def test_a_missing_log_is_rejected(tmp_path):
    with pytest.raises(LogError) as caught:
        read_log(tmp_path / "log.csv")
    assert caught.value.code == "not_readable"
