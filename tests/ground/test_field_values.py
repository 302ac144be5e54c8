"""Typed text as the fields of a Command."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.cli.cli_error import UsageError
from up_ground.field_values import parse_fields


def test_values_are_json_where_they_are_json_and_text_otherwise():
    words = ["a=2", "b=2.5", "c=true", "d=null", 'e="2"', "f=FBW", "g=", "h=x=y", "i=[1, 2]"]
    assert parse_fields(words) == {
        "a": 2,
        "b": 2.5,
        "c": True,
        "d": None,
        "e": "2",
        "f": "FBW",
        "g": "",
        "h": "x=y",
        "i": [1, 2],
    }


def test_dots_open_objects():
    words = ["pids.ratePIDs.ailerons.p=2", "pids.ratePIDs.ailerons.i=0", "pids.x=1"]
    assert parse_fields(words) == {"pids": {"ratePIDs": {"ailerons": {"p": 2, "i": 0}}, "x": 1}}


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity"])
def test_what_json_has_no_number_for_stays_text(word):
    assert parse_fields([f"a={word}"]) == {"a": word}


@pytest.mark.parametrize(
    "words", [["a"], ["=1"], ["a.=1"], [".a=1"], ["a..b=1"], ["a=1", "a=2"], ["a=1", "a.b=2"]]
)
def test_what_is_no_field_is_refused(words):
    with pytest.raises(UsageError):
        parse_fields(words)


@given(st.lists(st.text(max_size=30), max_size=5))
def test_no_words_break_it(words):
    try:
        data = parse_fields(words)
    except UsageError as error:
        assert str(error)
    else:
        json.dumps(data)
