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


JSON = st.recursive(
    st.none() | st.booleans() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
)
FIELDS = st.fixed_dictionaries({}, optional=dict.fromkeys((*REPORT, "aircraft", "guests"), JSON))


@given(st.binary() | (JSON | FIELDS).map(lambda each: json.dumps(each).encode()))
def test_any_answer_is_a_report_or_none(payload):
    found = report_in(payload)
    assert found is None or isinstance(found["aircraft"], list)


@given(st.from_regex(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,20}", fullmatch=True))
def test_a_name_in_a_key(name):
    assert "." not in word(name) and aircraft_of(f"instance.club.{word(name)}") == name
