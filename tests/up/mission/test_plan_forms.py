"""Files of either form: round trips, and what a damaged file costs."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.mission.plans import (
    FENCES,
    HOMES,
    MISSIONS,
    document,
    rows,
    simple,
    survey,
    waypoint,
)
from up.mission.items import MissionItem
from up.mission.plan import Plan, PlanError, checked_items
from up.mission.plan_forms import MAX_CHARACTERS, read_plan, write_plan


def problems(text):
    """Return (plan, item, code) of each problem of a text; none of it is read."""
    with pytest.raises(PlanError) as caught:
        read_plan(text, "a.plan")
    assert str(caught.value).startswith("a.plan: ")
    assert len(caught.value.problems) == len(caught.value.found)
    return [(each.plan, each.item, each.code) for each in caught.value.found]


@given(MISSIONS, FENCES, HOMES)
def test_a_plan_file_keeps_items_borders_and_home(items, borders, home):
    read = read_plan(write_plan(Plan("plan", items, borders, home, 17.5)), "a.plan")
    assert (read.items, read.borders, read.cruise_m_s) == (items, borders, 17.5)
    assert read.numbers == tuple(range(1, len(items) + 1))
    assert (read.form, read.notes) == ("plan", ())
    if home is not None:
        assert read.home == home


@given(MISSIONS, HOMES)
def test_a_waypoints_file_keeps_items_and_home(items, home):
    read = read_plan(write_plan(Plan("waypoints", items, (), home)), "a.waypoints")
    assert (read.form, read.items, read.home, read.notes) == ("waypoints", items, home, ())


_VALUES = st.sampled_from([None, True, -1, 10**400, 0.5, float("nan"), "x", [], [7], {}, {"a": 1}])
_POLYGON = {"inclusion": True, "polygon": [[50, 14], [50, 15], [51, 15]], "version": 1}
_CIRCLE = {"circle": {"center": [50, 14], "radius": 40}, "inclusion": False, "version": 1}


def places(given, path=()):
    """Yield the path of every value inside decoded JSON."""
    for key, inner in given.items() if isinstance(given, dict) else enumerate(given):
        yield (*path, key)
        if isinstance(inner, dict | list):
            yield from places(inner, (*path, key))


def sample():
    return document(
        waypoint(1), survey(2), simple(7, 177, 1, 2), polygons=[_POLYGON], circles=[_CIRCLE]
    )


@given(st.sampled_from([*places(sample())]), _VALUES)
def test_any_value_in_any_place_is_read_or_refused(path, value):
    given = json.loads(json.dumps(sample()))
    place = given
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    try:
        read = read_plan(json.dumps(given), "")
    except PlanError as error:
        assert error.found
    else:
        assert len(read.items) == len(read.numbers)


@given(st.lists(st.text(st.sampled_from("0123456789.-einfa\t _#é"), max_size=60)))
def test_any_rows_are_read_or_refused(lines):
    try:
        assert read_plan(rows(*lines), "").items == ()
    except PlanError as error:
        assert error.found


def test_one_character_less_is_noticed():
    text = json.dumps(document(waypoint(1)))
    assert problems(text[:-1]) == [("mission", 0, "not_json")]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "not_a_plan"),
        ("-35.36 149.16\n", "not_a_plan"),
        ("[1]", "not_a_plan"),
        ('{"fileType": "Params"}', "not_a_plan"),
        ("{" * 100_000, "not_json"),
        ('{"a": ' * 100_000, "not_json"),
        ("[" * 100_000, "not_json"),
        ('{"version": ' + "1" * 5000 + "}", "not_json"),
        ("QGC WPL 120\n", "version"),
        ("QGC WPL 110\n", "no_home"),
        (" " * (MAX_CHARACTERS + 1), "too_long"),
    ],
)
def test_what_is_no_plan_is_refused_as_a_whole(text, code):
    assert problems(text) == [("mission", 0, code)]


def test_a_byte_order_mark_is_ignored():
    assert len(read_plan("\ufeff" + json.dumps(document(waypoint(1))), "").items) == 1


def test_items_of_a_page_are_checked_one_by_one():
    good = {"kind": "waypoint", "latitude": 50, "longitude": 8, "altitude": 80}
    assert checked_items("mission", [good]) == (MissionItem("waypoint", 50.0, 8.0, 80.0),)
    with pytest.raises(PlanError) as caught:
        checked_items("mission", [{**good, "altitude": None}, good, 7])
    assert [(each.item, each.code) for each in caught.value.found] == [
        (1, "item_invalid"),
        (3, "item_invalid"),
    ]
