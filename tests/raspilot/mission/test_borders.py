import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raspilot.mission.borders import crosses, inside, leads_straight, local_borders, margin_m
from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import Border

FRAME = LocalFrame(48.0, 17.0)


def degrees(*points):
    return tuple(FRAME.degrees(Point(*each)) for each in points)


def polygon(*points, is_inside=True):
    return Border(is_inside, corners=degrees(*points))


def circle(north_m, east_m, radius_m, is_inside=True):
    latitude, longitude = degrees((north_m, east_m))[0]
    return Border(is_inside, latitude_deg=latitude, longitude_deg=longitude, radius_m=radius_m)


SQUARE = polygon((0, 0), (0, 400), (400, 400), (400, 0))
HOOK = polygon(
    (0, 0), (0, 300), (300, 300), (300, 200), (100, 200), (100, 100), (300, 100), (300, 0)
)
"""Two arms to the north; between them is outside."""
BOW = polygon((0, 0), (400, 400), (400, 0), (0, 400))


@pytest.mark.parametrize(
    ("borders", "point", "expected_m"),
    [
        ([], (5, 5), math.inf),
        ([SQUARE], (200, 150), 150),
        ([SQUARE], (-30, 200), -30),
        ([SQUARE], (430, 440), -50),
        ([SQUARE], (0, 100), 0),
        ([HOOK], (250, 150), -50),
        ([HOOK], (50, 150), 50),
        ([BOW], (200, 50), -math.sqrt(0.5) * 150),
        ([BOW], (390, 200), 10),
        ([circle(0, 0, 100)], (0, 30), 70),
        ([circle(0, 0, 100, is_inside=False)], (0, 130), 30),
        ([circle(0, 0, 100), circle(0, 150, 100)], (0, 110), 60),
        ([circle(0, 0, 100), circle(0, 300, 100)], (0, 150), -50),
        ([SQUARE, circle(200, 200, 50, is_inside=False)], (200, 270), 20),
        ([SQUARE, circle(200, 200, 50, is_inside=False)], (200, 230), -20),
        ([SQUARE, circle(200, 200, 50, is_inside=False)], (200, 395), 5),
    ],
)  # fmt: skip
def test_the_distance_to_the_nearest_place_outside(borders, point, expected_m):
    local = local_borders(borders, FRAME)
    assert margin_m(local, Point(*point)) == pytest.approx(expected_m, abs=1e-3)


@pytest.mark.parametrize(
    ("borders", "a", "b", "is_crossing"),
    [
        ([], (0, 0), (9999, 0), False),
        ([SQUARE], (10, 10), (390, 390), False),
        ([SQUARE], (10, 10), (390, 410), True),
        ([SQUARE], (500, 10), (390, 10), True),
        ([SQUARE], (500, 500), (500, 600), True),
        ([HOOK], (200, 50), (200, 250), True),
        ([HOOK], (50, 50), (50, 250), False),
        ([circle(0, 0, 100), circle(0, 150, 100)], (0, -90), (0, 240), False),
        ([circle(0, 0, 100), circle(0, 300, 100)], (0, 0), (0, 300), True),
        ([circle(0, 0, 100, is_inside=False)], (-200, 99), (200, 99), True),
        ([circle(0, 0, 100, is_inside=False)], (-200, 101), (200, 101), False),
        ([SQUARE, polygon((190, 0), (190, 400), (191, 400), (191, 0), is_inside=False)],
         (10, 10), (390, 10), True),
        ([SQUARE], (10, 10), (10, 10), False),
    ],
)  # fmt: skip
def test_a_leg_crosses_if_any_part_of_it_is_outside(borders, a, b, is_crossing):
    local = local_borders(borders, FRAME)
    assert crosses(local, Point(*a), Point(*b)) is is_crossing
    assert crosses(local, Point(*b), Point(*a)) is is_crossing


@pytest.mark.parametrize(
    ("borders", "home", "is_straight"),
    [
        ([], (0, 0), True),
        ([SQUARE], (10, 390), True),
        ([SQUARE], (-10, 200), False),
        ([HOOK], (50, 150), False),
        ([polygon((0, 0), (0, 300), (300, 300), (100, 150), (300, 0))], (50, 150), True),
        ([polygon((0, 0), (0, 300), (300, 300), (100, 150), (300, 0))], (250, 10), False),
        ([BOW], (10, 200), False),
        ([circle(0, 0, 100)], (0, 99), True),
        ([circle(0, 0, 100)], (0, 101), False),
        ([SQUARE, circle(200, 200, 30, is_inside=False)], (10, 10), False),
    ],
)  # fmt: skip
def test_where_the_way_home_is_straight_from_everywhere(borders, home, is_straight):
    assert leads_straight(local_borders(borders, FRAME), Point(*home)) is is_straight


def test_a_fence_over_the_antimeridian_is_whole():
    frame = LocalFrame(10.0, 179.999)
    border = Border(corners=((9.99, 179.99), (9.99, -179.99), (10.01, -179.99), (10.01, 179.99)))
    local = local_borders([border], frame)
    assert inside(local, Point(0.0, 0.0))
    assert inside(local, frame.point(10.0, -179.991))
    assert not inside(local, frame.point(10.0, -179.989))


coordinates = st.floats(-500, 500)
points = st.tuples(coordinates, coordinates).map(lambda each: Point(*each))
polygons = st.builds(
    lambda corners, is_inside: polygon(*corners, is_inside=is_inside),
    st.lists(points, min_size=3, max_size=8),
    st.booleans(),
)
circles = st.builds(circle, coordinates, coordinates, st.floats(30, 400), st.booleans())


@given(st.lists(polygons | circles, min_size=1, max_size=4), points, points)
def test_distance_and_legs_agree_for_any_fence(borders, a, b):
    local = local_borders(borders, FRAME)
    way = [Point(*(x + share / 50 * (y - x) for x, y in zip(a, b, strict=True)))
           for share in range(51)]  # fmt: skip
    margins = [margin_m(local, each) for each in way]
    step_m = math.dist(a, b) / 50
    assert all(abs(x - y) <= step_m + 1e-6 for x, y in pairwise(margins))
    if min(margins) < -1e-6:
        assert crosses(local, a, b)
    if min(margins) > step_m:
        assert not crosses(local, a, b)
