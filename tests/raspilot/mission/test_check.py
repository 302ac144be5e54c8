"""The check of a whole mission: every bad one by item and code."""

import time
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raspilot.failsafe.config import Fence
from raspilot.mission.check import Circumstances, check_fence, check_mission
from raspilot.mission.config import MissionConfig
from tests.raspilot.mission.plans_rig import items_of, placed
from tests.raspilot.navigation_rig import FRAME
from up.commands.command import InvalidCommandError
from up.flight_modes.navigation_state import Point
from up.mission.items import KINDS, Border

HOME = (48.0, 17.0, 250.0)
CALM = Circumstances(home=HOME)
WEST_WIND = replace(CALM, wind=Point(0.0, 10.0))
RETURN, LAND = {"kind": "return"}, placed(0, 300, kind="land", altitude=0.0)
TAKEOFF, FAST = {"kind": "takeoff", "altitude": 40.0}, {"kind": "speed", "airspeed": 15.0}
NORTH, EAST = placed(400, 0), placed(400, 400)
GOOD = [TAKEOFF, NORTH, FAST, EAST, {"kind": "jump", "item": 2, "repeat": 2}, LAND]


def jump(item, repeat=1):
    return {"kind": "jump", "item": item, "repeat": repeat}


def border(*corners, is_inside=True):
    return Border(is_inside, tuple(FRAME.degrees(Point(*each)) for each in corners))


BOX = border((-200, -200), (600, -200), (600, 600), (-200, 600))
"""EAST is 200 m inside of it."""
WALL = border((300, 180), (500, 180), (500, 200), (300, 200), is_inside=False)
"""Between NORTH and EAST."""

BAD = {
    "nothing to fly": ([FAST], CALM, {(0, "no_items")}),
    "too far": ([placed(5100, 0), RETURN], CALM, {(1, "too_far")}),
    "its circle is too far": (
        [placed(4950, 0, kind="loiter", radius=100)], CALM, {(1, "too_far")},
    ),
    "NaN": ([NORTH, {**EAST, "altitude": float("nan")}], CALM, {(2, "item_invalid")}),
    "too high": ([placed(400, 0, altitude=121.0), RETURN], CALM, {(1, "too_high")}),
    "too high above the sea": (
        [placed(400, 0, altitude=400.0, above_sea=True), RETURN], CALM, {(1, "too_high")},
    ),
    "too low": ([placed(400, 0, altitude=19.0), RETURN], CALM, {(1, "too_low")}),
    "too low take-off": (
        [{**TAKEOFF, "altitude": 5.0}, NORTH, RETURN], CALM, {(1, "too_low")},
    ),
    "above the ceiling": (
        [NORTH, RETURN], replace(CALM, fence=Fence(ceiling_m=65.0)), {(1, "fence")},
    ),
    "below the floor": ([NORTH, RETURN], replace(CALM, fence=Fence(floor_m=55.0)), {(1, "fence")}),
    "outside the radius": (
        [NORTH, EAST, RETURN], replace(CALM, fence=Fence(radius_m=500.0)), {(2, "fence")},
    ),
    "the fence would act before the corner": (
        [NORTH, placed(575, 0), placed(575, -150), RETURN], replace(CALM, borders=(BOX,)),
        {(2, "fence")},
    ),
    "a leg crosses a border": ([NORTH, EAST, RETURN], replace(CALM, borders=(WALL,)),
                               {(2, "fence")}),
    "outside of every border": (
        [NORTH, placed(400, 700), RETURN], replace(CALM, borders=(BOX,)),
        {(2, "fence"), (3, "fence")},
    ),
    "a circle crosses a border": (
        [NORTH, placed(400, 480, kind="loiter", radius=120)], replace(CALM, borders=(BOX,)),
        {(2, "fence")},
    ),
    "a short leg between turns": (
        [placed(200, 0), NORTH, placed(400, 30), placed(200, 30), RETURN], CALM, {(3, "turn")},
    ),
    "the same place twice": ([NORTH, NORTH, placed(600, 0), RETURN], CALM, {(2, "turn")}),
    "long enough in calm air only": (
        [placed(200, 0), NORTH, placed(400, 60), placed(0, 60), RETURN],
        replace(CALM, wind=Point(7.0, 0.0)), {(3, "turn")},
    ),
    "a short climb": (
        [placed(400, 0, altitude=20.0), placed(600, 0, altitude=100.0), RETURN], CALM,
        {(2, "climb")},
    ),
    "a short descent": (
        [placed(400, 0, altitude=100.0), placed(900, 0, altitude=50.0), RETURN], CALM,
        {(2, "climb")},
    ),
    "against the wind": ([NORTH, placed(400, -400), placed(0, -400), RETURN],
                         WEST_WIND, {(2, "wind")}),
    "too slow": ([{"kind": "speed", "airspeed": 7.9}, NORTH, RETURN], CALM, {(1, "airspeed")}),
    "too fast": ([{"kind": "speed", "airspeed": 16.5}, NORTH, RETURN], CALM, {(1, "airspeed")}),
    "a jump beyond the end": ([NORTH, jump(9)], CALM, {(2, "jump")}),
    "a loop of one jump": ([NORTH, jump(2)], CALM, {(2, "jump")}),
    "a loop of jumps and speeds": (
        [jump(3), NORTH, FAST, jump(1)], CALM, {(1, "jump"), (4, "jump")},
    ),
    "after return": ([NORTH, RETURN, EAST], CALM, {(3, "after_end")}),
    "after an endless loiter": ([placed(400, 0, kind="loiter"), EAST], CALM, {(2, "after_end")}),
    "after an endless jump": ([NORTH, EAST, jump(1, -1), RETURN], CALM, {(4, "after_end")}),
    "take-off in flight": ([NORTH, TAKEOFF, EAST], CALM, {(2, "item_invalid")}),
    "no such mode": (
        [TAKEOFF, NORTH, LAND], replace(CALM, modes={"RETURN"}),
        {(1, "mode_unknown"), (3, "mode_unknown")},
    ),
    "10,000 items": ([NORTH] * 10_000, CALM, {(0, "too_many")}),
    "too many ways": ([NORTH, *[jump(1)] * 60, *[EAST, NORTH, *[jump(1)] * 3] * 60], CALM, None),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_mission_is_refused_by_item_and_code(name):
    data, circumstances, expected = BAD[name]
    if name == "NaN":
        with pytest.raises(InvalidCommandError):
            items_of(data)
        return
    found = check_mission(items_of(data), circumstances)
    if expected is None:
        assert found
    else:
        assert {(each.item, each.code) for each in found} == expected, found


def test_a_good_mission_has_no_problems():
    assert check_mission(items_of(GOOD), CALM) == []
    inside = replace(CALM, borders=(BOX,), fence=Fence(radius_m=800.0, ceiling_m=80.0, floor_m=20))
    assert check_mission(items_of([NORTH, placed(400, 300), RETURN]), inside) == []


def test_without_home_what_does_not_depend_on_it_is_checked():
    nowhere = Circumstances()
    assert check_mission(items_of(GOOD), nowhere) == []
    far = [placed(400, 0), placed(90_000, 0, altitude=130.0)]
    assert {each.code for each in check_mission(items_of(far), nowhere)} == {"too_high"}


def test_a_wall_away_from_the_legs_does_not_matter():
    away = border((-300, -180), (-500, -180), (-500, -200), is_inside=False)
    assert check_mission(items_of([NORTH, EAST, RETURN]), replace(CALM, borders=(away,))) == []


def test_a_fence_is_refused_by_what_is_outside():
    mission = items_of([NORTH, EAST, RETURN])
    assert check_fence([BOX], mission, CALM) == []
    for fence in ([WALL], [border((300, -50), (500, -50), (500, 500), (300, 500))]):
        found = check_fence(fence, mission, CALM)
        assert [(each.item, each.code) for each in found] == [(0, "home_outside")]
    assert [each.code for each in check_fence([BOX] * 51, [], CALM)] == ["too_many"]
    bow = border((-500, -500), (500, 500), (500, -500), (-500, 500))
    found = check_fence([BOX, bow], mission, CALM)
    assert [(each.item, each.code) for each in found] == [(2, "crosses_itself")]


def test_the_longest_mission_in_the_largest_fence_is_checked_in_seconds():
    items = items_of([placed(400 + 200 * (each % 2), 5.0 * each) for each in range(700)])
    walls = [
        border(*((-3000 + n, -3000 + 40 * each + n % 3) for n in range(100)), is_inside=False)
        for each in range(50)
    ]
    begin = time.process_time()
    found = check_mission(items, replace(CALM, borders=walls, limits=MissionConfig(9000)))
    assert {each.code for each in found} <= {"turn", "fence"}
    assert time.process_time() - begin < 20.0


numbers = st.floats(-2e4, 2e4)
places = st.builds(
    placed, numbers, numbers, kind=st.sampled_from(sorted(KINDS)),
    altitude=st.floats(-1000, 9000), above_sea=st.booleans(), over=st.booleans(),
    radius=st.none() | st.floats(10, 1000), turns=st.floats(0.1, 1000), item=st.integers(1, 12),
    repeat=st.integers(-1, 1000), airspeed=st.floats(3, 60),
)  # fmt: skip
borders = st.lists(st.tuples(numbers, numbers), min_size=3, max_size=6).map(
    lambda corners: border(*corners)
)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(places, max_size=12),
    st.lists(borders, max_size=2),
    st.builds(Point, st.floats(-40, 40), st.floats(-40, 40)),
    st.none() | st.just(HOME),
)
def test_any_mission_gets_an_answer_that_names_its_items(data, fence, wind, home):
    circumstances = Circumstances(borders=fence, home=home, wind=wind)
    for each in check_mission(items_of(data), circumstances):
        assert 0 <= each.item <= len(data)
        assert each.code and each.text
