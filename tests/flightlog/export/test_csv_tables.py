"""Tables: every value comes back out of the cell that it went into."""

import csv
import io
import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from up_flightlog.export.csv_table import cell, flat, topic_lines, wide_lines
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


def read_again(lines):
    """Through a file and Python's own reader, whose writer writes the same."""
    written = "".join(lines).encode().decode()
    rows = list(csv.reader(io.StringIO(written, newline=""), strict=True))
    again = io.StringIO(newline="")
    csv.writer(again, lineterminator="\n").writerows(rows)
    assert again.getvalue() == written
    return rows, written


def topic(messages, start_unix_s=1.7e9):
    return read_again(topic_lines(messages, start_unix_s, io.StringIO(newline="\n")))


def wide(messages, length_s, rate_hz, start_unix_s=1_700_000_000):
    spool = io.StringIO(newline="\n")
    return read_again(wide_lines(messages, start_unix_s, length_s, rate_hz, spool))[0]


@settings(deadline=None)
@given(st.lists(DATA, min_size=1, max_size=6))
def test_a_message_is_a_row_and_a_row_a_line(contents):
    messages = [LoggedMessage("a", at / 10, data) for at, data in enumerate(contents)]
    rows, written = topic(messages)
    paths = list(dict.fromkeys(path for each in messages for path, _ in flat(each.data)))
    assert rows[0][2:] == [cell(path) for path in paths]
    assert len(rows) == len(messages) + 1 == len(written.splitlines())
    assert all(len(row) == len(paths) + 2 for row in rows)
    for message, row in zip(messages, rows[1:], strict=True):
        assert float(row[0]) == message.time_s
        found = dict(flat(message.data))
        for path, shown in zip(paths, row[2:], strict=True):
            value = found.get(path)
            if isinstance(value, bool | str) or value is None:
                assert shown == cell(value)
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
    assert wide(FLIGHT, 1.5, 2) == [
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
    assert len(wide(FLIGHT, 10.0, rate_hz)) == 1 + int(10 * rate_hz) + 1


def test_cells_that_appear_later_are_empty_before_and_keep_their_place():
    messages = [
        LoggedMessage("a", 0.0, {}),
        LoggedMessage("a", 1.0, {"x": {"y": 1}}),
        LoggedMessage("b", 2.0, {"text": 'one, "two"'}),
        LoggedMessage("a", 2.0, {"z": 2, "x": {"y": 3}}),
        LoggedMessage("a", 3.0, {"x": {"y": None}}),
        LoggedMessage("a", 3.5, {"last": True}),
        LoggedMessage("c", 3.6, {"last": True}),
    ]
    rows = wide(messages, 3.6, 1)
    assert rows[0][2:] == [
        "a.x.y",
        "a.z",
        "a.last",
        "a.age_s",
        "b.text",
        "b.age_s",
        "c.last",
        "c.age_s",
    ]
    assert [row[2:] for row in rows[1:]] == [
        ["", "", "", "0.000", "", "", "", ""],
        ["1", "", "", "0.000", "", "", "", ""],
        ["3", "2", "", "0.000", 'one, "two"', "0.000", "", ""],
        ["", "", "", "0.000", 'one, "two"', "1.000", "", ""],
    ]


def test_equal_keys_in_other_maps_are_other_cells():
    messages = [
        LoggedMessage("a", 0.0, {"x": {"y": 1}, "z": 2}),
        LoggedMessage("a", 1.0, {"x": {"y": 3, "z": 4}}),
        LoggedMessage("a", 2.0, {"z": 5, "x": {"y": 6}}),
    ]
    rows, _ = topic(messages)
    assert [row[2:] for row in rows] == [
        ["x.y", "z", "x.z"],
        ["1", "2", ""],
        ["3", "", "4"],
        ["6", "5", ""],
    ]
    rows, _ = topic(
        [
            LoggedMessage("a", 0.0, {"a": 1, "b": {"c": {}}}),
            LoggedMessage("a", 1.0, {"a": {"b": {"c": 2}}}),
        ]
    )
    assert [row[2:] for row in rows] == [["a", "a.b.c"], ["1", ""], ["", "2"]]
