"""QGroundControl's plans: what each item becomes, and every mistake with its number."""

import json

import pytest

from tests.up.mission.plans import document, simple, survey, waypoint
from tests.up.mission.test_plan_forms import problems
from up.mission.items import Border, MissionItem
from up.mission.plan_forms import read_plan

NAN, HUGE = float("nan"), 10**400
SQUARE = [[50.07, 14.41], [50.07, 14.45], [50.09, 14.45], [50.09, 14.41]]
POLYGON = {"inclusion": True, "polygon": SQUARE, "version": 1}
CIRCLE = {"circle": {"center": [50.08, 14.43], "radius": 40.5}, "inclusion": False, "version": 1}


def read(*items, **more):
    return read_plan(json.dumps(document(*items, **more)), "a.plan")


def found(*items, **more):
    return problems(json.dumps(document(*items, **more)))


def test_a_mission_of_a_multicopter_with_a_camera():
    plan = read(
        simple(1, 22, 15, 0, 0, None, 50.078, 14.42, 50),
        waypoint(2),
        simple(3, 2000, 0, 0, 1, frame=2),
        waypoint(4, altitude=90.5, frame=0),
        simple(5, 20, frame=2),
    )
    assert plan.items == (
        MissionItem("takeoff", altitude_m=50.0),
        MissionItem("waypoint", 50.08, 14.43, 60.0),
        MissionItem("waypoint", 50.08, 14.43, 90.5, is_above_sea=True),
        MissionItem("return"),
    )
    assert (plan.numbers, plan.borders) == ((1, 2, 4, 5), ())
    assert [(each.item, each.code) for each in plan.notes] == [(3, "left_out")]
    assert (plan.home, plan.cruise_m_s) == ((50.07812345678901, 14.42, 231.5), 15.0)


def test_the_items_of_a_survey_stand_in_its_place():
    plan = read(simple(1, 530, 0, 2, None, None, frame=2), survey(2), waypoint(7, altitude=70))
    assert [each.longitude_deg for each in plan.items] == [14.43, 14.431, 14.432, 14.43]
    assert plan.numbers == (2, 4, 6, 7)
    assert [each.item for each in plan.notes] == [1, 3, 5]


def test_a_fence_without_a_mission():
    plan = read(polygons=[POLYGON, {**POLYGON, "inclusion": False}], circles=[CIRCLE])
    corners = tuple(map(tuple, SQUARE))
    circle = Border(is_inside=False, latitude_deg=50.08, longitude_deg=14.43, radius_m=40.5)
    assert plan.borders == (Border(True, corners), Border(False, corners), circle)


def test_loiters_turn_the_way_of_their_radius():
    place = (None, 50.08, 14.43, 60)
    plan = read(
        simple(1, 17, 0, 0, -80, *place),
        simple(2, 18, 2.5, 0, 80, *place),
        simple(3, 19, 22, 0, 0, *place),
        simple(4, 31, 1, -120, 0, *place),
    )
    told = [(each.kind, each.radius_m, each.is_clockwise) for each in plan.items]
    assert told == [
        ("loiter", 80.0, False),
        ("loiter_turns", 80.0, True),
        ("loiter_time", None, True),
        ("loiter_time", 120.0, False),
    ]
    assert [(each.turns, each.time_s) for each in plan.items[1:]] == [(2.5, 0), (1, 22), (1, 0)]


@pytest.mark.parametrize(
    ("acceptance_m", "pass_by_m", "is_over"),
    [
        (0, 0, False),
        (1, 0, True),
        (10, 0, True),
        (30, 0, False),
        (0, 80, True),
        (None, None, False),
    ],
)
def test_a_small_acceptance_radius_or_a_pass_by_is_flown_over(acceptance_m, pass_by_m, is_over):
    (item,) = read(simple(1, 16, 0, acceptance_m, pass_by_m, None, 50.08, 14.43, 60)).items
    assert item.is_over is is_over


def test_a_jump_names_an_item_by_its_id_and_what_was_left_out_counts_as_the_next():
    plan = read(
        waypoint(4), simple(9, 2000), waypoint(6), simple(7, 177, 9, 3), simple(8, 177, 4, -1)
    )
    jumps = [(each.item, each.repeat) for each in plan.items if each.kind == "jump"]
    assert jumps == [(2, 3), (1, -1)]


@pytest.mark.parametrize(
    ("item", "code"),
    [
        (simple(2, 9999), "command_unknown"),
        (simple(2, None), "command_unknown"),
        (simple(2, True), "command_unknown"),
        (simple(2, 84), "command_unsupported"),
        (simple(2, 179, 1), "command_unsupported"),
        (waypoint(2, frame=10), "frame"),
        (waypoint(2, frame="3"), "frame"),
        (waypoint(2, 0, 0), "no_position"),
        (waypoint(2, NAN), "item_invalid"),
        (waypoint(2, HUGE), "item_invalid"),
        (waypoint(2, "50"), "item_invalid"),
        (waypoint(2, None), "item_invalid"),
        (waypoint(2, altitude=1e9), "item_invalid"),
        (simple(2, 18, NAN, 0, 0, 0, 50, 14, 60), "item_invalid"),
        (simple(2, 17, 0, 0, NAN, 0, 50, 14, 60), "item_invalid"),
        (simple(2, 17, 0, 0, HUGE, 0, 50, 14, 60), "item_invalid"),
        (simple(2, 17, 0, 0, 5, 0, 50, 14, 60), "item_invalid"),
        (simple(2, 178, 1, 15, -1), "value"),
        (simple(2, 178, 0, 15, 80), "value"),
        (simple(2, 178, 0, -1, -1), "item_invalid"),
        (simple(2, 177, 5, 1), "jump"),
        (simple(2, 177, NAN, 1), "jump"),
        (simple(2, 177, 1, 0.5), "item_invalid"),
        ({**waypoint(2), "params": [0, 0]}, "incomplete"),
        ({"type": "SimpleItem", "command": 16}, "incomplete"),
        ({**survey(2), "TransectStyleComplexItem": {}}, "pattern_unsupported"),
        ({"type": "ComplexItem", "complexItemType": "fwLandingPattern"}, "pattern_unsupported"),
        (7, "incomplete"),
    ],
)
def test_a_mistake_names_the_item_and_nothing_is_read(item, code):
    assert found(waypoint(1), item, waypoint(3)) == [("mission", 2, code)]


def test_a_jump_to_an_id_of_two_items_is_refused():
    assert found(waypoint(1), waypoint(1), simple(3, 177, 1, 2)) == [("mission", 3, "jump")]


@pytest.mark.parametrize(
    ("border", "code"),
    [
        ({**POLYGON, "polygon": SQUARE[:2]}, "item_invalid"),
        ({**POLYGON, "polygon": [*SQUARE, [NAN, 14.4]]}, "item_invalid"),
        ({**POLYGON, "polygon": SQUARE * 26}, "item_invalid"),
        ({**POLYGON, "inclusion": None}, "item_invalid"),
        ({"inclusion": True}, "item_invalid"),
        ([], "item_invalid"),
    ],
)
def test_a_wrong_border_has_its_number(border, code):
    assert found(waypoint(1), polygons=[POLYGON, border]) == [("fence", 2, code)]


def test_circles_are_numbered_after_polygons():
    small = {**CIRCLE, "circle": {"center": [50, 14], "radius": 3}}
    wrong = {**CIRCLE, "circle": {"center": [50], "radius": 40}}
    assert found(polygons=[POLYGON], circles=[CIRCLE, small, wrong]) == [
        ("fence", 3, "item_invalid"),
        ("fence", 4, "item_invalid"),
    ]


def test_all_problems_are_reported_together():
    several = found(waypoint(1, NAN), simple(2, 84), circles=[{}], version=3)
    assert several == [
        ("mission", 0, "version"),
        ("mission", 1, "item_invalid"),
        ("mission", 2, "command_unsupported"),
        ("fence", 1, "item_invalid"),
    ]


def test_ten_thousand_items_are_one_problem():
    assert found(*[simple(each, 9999) for each in range(10_000)]) == [("mission", 701, "too_many")]
    assert found(polygons=[POLYGON] * 51) == [("fence", 51, "too_many")]


@pytest.mark.parametrize(
    ("key", "place"),
    [
        ('"command": 16, ', ("mission", 1)),
        ('"cruiseSpeed": 15, ', ("mission", 0)),
        ('"fileType": "Plan", ', ("mission", 0)),
        ('"inclusion": true, ', ("fence", 1)),
    ],
)
def test_a_repeated_key_is_refused_with_its_place(key, place):
    text = json.dumps(document(waypoint(1), polygons=[POLYGON]))
    assert problems(text.replace(key, key + key)) == [(*place, "key_repeated")]


@pytest.mark.parametrize(
    ("part", "value", "expected"),
    [
        ("mission", None, ("mission", 0, "incomplete")),
        ("mission", {"version": 2, "items": {}}, ("mission", 0, "incomplete")),
        ("mission", {"version": 1, "items": []}, ("mission", 0, "version")),
        ("geoFence", 7, ("fence", 0, "incomplete")),
        ("geoFence", {"polygons": [POLYGON], "circles": [], "version": 1}, ("fence", 0, "version")),
        ("version", 2, ("mission", 0, "version")),
    ],
)
def test_a_wrong_part_is_named(part, value, expected):
    assert problems(json.dumps({**document(), part: value})) == [expected]


@pytest.mark.parametrize("home", [[NAN, 14, 0], [50, 14], [91, 14, 0], "home"])
def test_a_home_that_is_no_position_is_refused(home):
    assert found(waypoint(1), plannedHomePosition=home) == [("mission", 0, "home")]


def test_rally_points_and_the_breach_return_are_left_out_with_a_note():
    given = document(polygons=[POLYGON])
    given["geoFence"]["breachReturn"] = [50.08, 14.43, 60]
    given["rallyPoints"]["points"] = [[50.08, 14.43, 60]]
    notes = read_plan(json.dumps(given), "").notes
    assert [(each.plan, each.item, each.code) for each in notes] == [
        ("mission", 0, "left_out"),
        ("fence", 0, "left_out"),
    ]


def test_a_hold_time_is_left_out_with_a_note():
    (note,) = read(simple(1, 16, 5, 0, 0, 0, 50.08, 14.43, 60)).notes
    assert (note.item, note.code) == (1, "hold")
