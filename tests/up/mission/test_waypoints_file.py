import pytest

from tests.up.mission.plans import HOME_ROW, row, rows
from tests.up.mission.test_plan_forms import problems
from up.mission.items import Border, MissionItem
from up.mission.plan import Plan, PlanError
from up.mission.plan_forms import read_plan, write_plan

PLACE = (0, 50.08, 14.43, 60)
WAYPOINT = MissionItem("waypoint", 50.08, 14.43, 60.0)


def test_the_first_row_is_home_and_comments_are_skipped():
    plan = read_plan(
        rows(
            "# one of each",
            row(1, 22, 15, 0, 0, 0, 50.079, 14.42, 40),
            row(2, 16, 0, 0, 0, *PLACE),
            row(3, 178, 0, 13),
            row(4, 189),
            row(5, 177, 2, 2),
            "",
            row(6, 21, 0, 0, 0, *PLACE[:3], 0),
        ),
        "a.waypoints",
    )
    assert plan.items == (
        MissionItem("takeoff", altitude_m=40.0),
        WAYPOINT,
        MissionItem("speed", airspeed_m_s=13.0),
        MissionItem("jump", item=2, repeat=2),
        MissionItem("land", 50.08, 14.43, 0.0),
    )
    assert (plan.home, plan.numbers) == ((50.078, 14.42, 231.5), (1, 2, 3, 5, 6))
    assert [(each.item, each.code) for each in plan.notes] == [(4, "left_out")]


def test_a_home_of_zeros_is_none():
    plan = read_plan("QGC WPL 110\n" + row(0, 16, frame=0), "")
    assert (plan.home, plan.items) == (None, ())


@pytest.mark.parametrize(
    ("line", "code"),
    [
        (row(2, 16, 0, 0, 0, *PLACE)[:-2], "incomplete"),
        (row(2, 16, 0, 0, 0, *PLACE) + "\t1", "incomplete"),
        ("2", "incomplete"),
        (row(2, 16, 0, 0, 0, 0, float("nan"), 14, 60), "item_invalid"),
        (row(2, 16, 0, 0, 0, 0, float("inf"), 14, 60), "item_invalid"),
        (row(2, 16, 0, 0, 0, *PLACE).replace("50.08", "50,08"), "item_invalid"),
        (row(2, 16, 0, 0, 0, *PLACE).replace("50.08", "5_0.08"), "item_invalid"),
        (row(2, 16, 0, 0, 0, *PLACE).replace("50.08", "9" * 39), "item_invalid"),
        (row(2, 16, 0, 0, 0, *PLACE).replace("50.08", "9" * 100_000), "item_invalid"),
        (row(2, 18, 1, 0, 80, 0, 0, 0, 60), "no_position"),
        (row(2, 36, 90, 0, 0, *PLACE), "command_unsupported"),
        (row(2, 16, 0, 0, 0, *PLACE, frame=10), "frame"),
        (row(2, "x", 0, 0, 0, *PLACE), "command_unknown"),
        (row(2, 177, 0, 1), "jump"),
    ],
)
def test_a_mistake_names_the_row(line, code):
    good = [row(each, 16, 0, 0, 0, *PLACE) for each in (1, 3)]
    assert problems(rows(good[0], line, good[1])) == [("mission", 2, code)]


def test_a_home_that_is_no_position_is_refused():
    text = rows(row(1, 16, 0, 0, 0, *PLACE))
    assert problems(text.replace(HOME_ROW, HOME_ROW.replace("50.078", "150.078"))) == [
        ("mission", 0, "home")
    ]


def test_ten_thousand_rows_are_one_problem():
    many = rows(*(row(each, 16, 0, 0, 0, *PLACE) for each in range(1, 10_001)))
    assert problems(many) == [("mission", 701, "too_many")]


def test_a_fence_has_no_place_in_it():
    border = Border(latitude_deg=50.0, longitude_deg=14.0, radius_m=100.0)
    with pytest.raises(PlanError) as caught:
        write_plan(Plan("waypoints", (WAYPOINT,), (border,)))
    assert caught.value.code == "no_fence"
