"""What a member answers: anything but a report is left out."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_cluster.fleet.fleet import report_in
from up_cluster.membership import aircraft_of, word

REPORT = {"id": "3f9a0c27b1d4", "kind": "proxy", "host": "kite", "is_draining": False}
ROW = {"aircraft": "glider-1", "state": "online"}


def test_a_report():
    report = {**REPORT, "aircraft": [ROW]}
    assert report_in(json.dumps(report).encode()) == report


@pytest.mark.parametrize(
    "other",
    [
        {"id": 1},
        {"host": None},
        {"is_draining": 0},
        {"aircraft": 1},
        {"aircraft": [{}]},
        {"guests": {}},
        {"guests": [1]},
    ],
)
def test_no_report(other):
    report = {**REPORT, "aircraft": [ROW], **other}
    assert report_in(json.dumps(report).encode()) is None


@given(
    st.binary()
    | st.recursive(st.none() | st.text(), st.lists).map(lambda x: json.dumps(x).encode())
)
def test_any_answer_is_a_report_or_none(payload):
    assert report_in(payload) is None


@given(st.from_regex(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,20}", fullmatch=True))
def test_a_name_in_a_key(name):
    assert "." not in word(name) and aircraft_of(f"instance.club.{word(name)}") == name
