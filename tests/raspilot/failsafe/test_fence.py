"""The fence acts before it is crossed, and knows how uncertain the estimate is."""

from dataclasses import replace

import pytest

from raspilot.failsafe.config import Fence
from raspilot.failsafe.fence import FenceWatch
from tests.raspilot.mission.test_borders import polygon
from up.flight_modes.flight_mode import Home
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point

HOME = Home(Point(0.0, 0.0), 200.0)
INSIDE = NavigationState(
    0.0, LocalFrame(48.0, 17.0), Point(400.0, 0.0), Point(10.0, 0.0), 280.0, 0.0, Point(0.0, 0.0),
    10.0, 0.0, 0.0, 0.0, 2.0, 3.0, 0.5, 0.5, 2.0, 0.5,
)  # fmt: skip
INWARDS = Point(-10.0, 0.0)


@pytest.mark.parametrize(
    ("fence", "changed", "is_crossed"),
    [
        (Fence(), {}, False),
        (Fence(radius_m=500), {}, False),
        (Fence(radius_m=500), {"position": Point(457.0, 0.0)}, False),
        (Fence(radius_m=500), {"position": Point(459.0, 0.0)}, True),
        (Fence(radius_m=500), {"position": Point(490.0, 0.0), "velocity": INWARDS}, False),
        (Fence(radius_m=500), {"position": Point(505.0, 0.0), "velocity": INWARDS}, True),
        (Fence(radius_m=500), {"position_sd_m": 61.0}, True),
        (Fence(ceiling_m=100), {"climb_m_s": 4.2}, False),
        (Fence(ceiling_m=100), {"climb_m_s": 4.3}, True),
        (Fence(ceiling_m=100), {"altitude_sd_m": 21.0}, True),
        (Fence(floor_m=70), {"climb_m_s": -1.7}, False),
        (Fence(floor_m=70), {"climb_m_s": -1.8}, True),
    ],
)  # fmt: skip
def test_a_border_is_crossed_four_seconds_before(fence, changed, is_crossed):
    watch = FenceWatch(fence)
    assert not watch.is_crossed(INSIDE, HOME)
    names = {"position": "position", "velocity": "velocity_m_s"}
    state = replace(INSIDE, **{names.get(name, name): each for name, each in changed.items()})
    assert watch.is_crossed(state, HOME) is is_crossed


def test_the_floor_counts_from_the_first_climb_above_it():
    watch = FenceWatch(Fence(floor_m=30))
    heights = (5.0, 20.0, 60.0, 20.0)
    low = [replace(INSIDE, altitude_m=200.0 + height_m) for height_m in heights]
    assert [watch.is_crossed(state, HOME) for state in low] == [False, False, False, True]


def test_without_home_or_position_there_is_no_fence():
    watch = FenceWatch(Fence(radius_m=100))
    assert not watch.is_crossed(INSIDE, None)
    assert not watch.is_crossed(None, HOME)


WALL = polygon((440, -90), (440, 90), (445, 90), (445, -90), is_inside=False)
FIELD = polygon((-100, -100), (-100, 100), (500, 100), (500, -100))


@pytest.mark.parametrize(
    ("plan", "changed", "is_crossed", "margin_m"),
    [
        ([FIELD], {}, False, 100),
        ([FIELD], {"position": Point(457.0, 0.0)}, False, 43),
        ([FIELD], {"position": Point(459.0, 0.0)}, True, 41),
        ([FIELD], {"position": Point(490.0, 0.0), "velocity": INWARDS}, False, 10),
        ([FIELD], {"position": Point(505.0, 0.0), "velocity": INWARDS}, True, -5),
        ([FIELD], {"position_sd_m": 61.0}, True, 100),
        ([FIELD, WALL], {"position": Point(430.0, 0.0)}, True, 10),
        ([FIELD, WALL], {"position": Point(390.0, 0.0)}, False, 50),
    ],
)  # fmt: skip
def test_polygons_act_as_early_and_a_narrow_one_is_not_leapt_over(
    plan, changed, is_crossed, margin_m
):
    watch = FenceWatch(Fence())
    watch.is_crossed(INSIDE, None)
    assert watch.margin_m is None
    watch.use(tuple(plan))
    names = {"position": "position", "velocity": "velocity_m_s"}
    state = replace(INSIDE, **{names.get(name, name): each for name, each in changed.items()})
    assert watch.is_crossed(state, None) is is_crossed, "it needs no home"
    assert watch.margin_m == pytest.approx(margin_m, abs=1e-3)
    watch.use(())
    assert not watch.is_crossed(state, None)


def test_borders_are_at_their_place_when_the_frame_of_the_estimate_changes():
    watch = FenceWatch(Fence())
    watch.use((FIELD,))
    assert not watch.is_crossed(INSIDE, None)
    moved = replace(INSIDE, frame=LocalFrame(*INSIDE.frame.degrees(Point(300.0, 0.0))))
    assert watch.is_crossed(moved, None)
    assert watch.margin_m == pytest.approx(-200, abs=0.1)


def test_the_nearest_of_radius_and_polygon_counts():
    watch = FenceWatch(Fence(radius_m=450))
    watch.use((FIELD,))
    watch.is_crossed(INSIDE, HOME)
    assert watch.margin_m == pytest.approx(50)
