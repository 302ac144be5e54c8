"""Tables: every value comes back out of the cell that it went into."""

import csv
import io
import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from up_flightlog.export.csv_table import cell, columns_of, flat, topic_rows, wide_rows
from up_flightlog.read.flight_log import LoggedMessage

SCALARS = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(max_size=20)
)
DATA = st.dictionaries(
    st.text(max_size=8), SCALARS | st.dictionaries(st.text(max_size=5), SCALARS, max_size=3)
)


def read_again(rows):
    """Through a file and Python's own reader."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    written = text.getvalue().encode().decode()
    return list(csv.reader(io.StringIO(written, newline=""), strict=True)), written


@settings(deadline=None)
@given(st.lists(DATA, min_size=1, max_size=6))
def test_a_message_is_a_row_and_a_row_a_line(contents):
    messages = [LoggedMessage("a", at / 10, data) for at, data in enumerate(contents)]
    paths = columns_of(messages).get("a", [])
    rows, written = read_again(topic_rows(messages, paths, 1.7e9))
    assert len(rows) == len(messages) + 1 == len(written.splitlines())
    assert all(len(row) == len(paths) + 2 for row in rows)
    for message, row in zip(messages, rows[1:], strict=True):
        assert float(row[0]) == message.time_s
        found = dict(flat(message.data))
        for path, shown in zip(paths, row[2:], strict=True):
            value = found.get(path)
            if isinstance(value, bool | str) or value is None:
                continue
            assert float(shown) == value if isinstance(value, float) else int(shown) == value


@settings(deadline=None)
@given(st.text())
def test_no_text_is_calculated_by_a_spreadsheet(text):
    shown = cell(text)
    assert not shown.startswith(("=", "+", "-", "@"))
    assert shown.isprintable()


def test_cells():
    assert [cell(each) for each in (None, True, 0.1, 3, "x", math.nan, math.inf)] == [
        *("", "true", "0.1", "3", "x", "", ""),
    ]
    assert cell('=HYPERLINK("x")') == '\'=HYPERLINK("x")'
    assert cell(-1) == "-1"
    assert cell("a\nb\x1b") == "a\\nb\\x1b"
    assert json.loads(cell([1, {"a": 2}])) == [1, {"a": 2}]


def test_inner_values_have_dotted_names():
    data = {"rates": {"roll": 1, "deep": {"er": 2}}, "empty": {}, "list": [1]}
    assert list(flat(data)) == [("rates.roll", 1), ("rates.deep.er", 2), ("list", [1])]


FLIGHT = [
    LoggedMessage("attitude", 0.0, {"roll": 1.0}),
    LoggedMessage("battery", 0.1, {"level": 90}),
    LoggedMessage("attitude", 0.5, {"roll": 2.0}),
    LoggedMessage("attitude", 1.0, {"roll": 3.0, "pitch": 4.0}),
]


def test_a_wide_table_has_the_newest_values_and_their_ages():
    rows, _ = read_again(wide_rows(FLIGHT, columns_of(FLIGHT), 1_700_000_000, 1.5, 2))
    assert rows == [
        [
            *("time_s", "time", "attitude.roll", "attitude.pitch", "attitude.age_s"),
            *("battery.level", "battery.age_s"),
        ],
        ["0.000000", "2023-11-14T22:13:20.000Z", "1.0", "", "0.000", "", ""],
        ["0.500000", "2023-11-14T22:13:20.500Z", "2.0", "", "0.000", "90", "0.400"],
        ["1.000000", "2023-11-14T22:13:21.000Z", "3.0", "4.0", "0.000", "90", "0.900"],
        ["1.500000", "2023-11-14T22:13:21.500Z", "3.0", "4.0", "0.500", "90", "1.400"],
    ]


@pytest.mark.parametrize("rate_hz", [0.1, 1, 7, 100])
def test_the_rate_makes_the_rows(rate_hz):
    rows = list(wide_rows(FLIGHT, columns_of(FLIGHT), 0, 10.0, rate_hz))
    assert len(rows) == 1 + int(10 * rate_hz) + 1
