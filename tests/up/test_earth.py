import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.earth import bearing_deg, compass_deg, distance_m

LATITUDES = st.floats(-90, 90)
LONGITUDES = st.floats(-180, 180)


@pytest.mark.parametrize(
    ("a", "b", "metres", "bearing"),
    [
        ((0, 0), (0, 1), 111_195, 90),
        ((0, 0), (1, 0), 111_195, 0),
        ((0, 0), (0, -1), 111_195, 270),
        ((49.2, 16.6), (50.1, 14.4), 186_600, 304),
        ((0, 179.5), (0, -179.5), 111_195, 90),
        ((10, 10), (10, 10), 0, 0),
    ],
)
def test_known_ones(a, b, metres, bearing):
    assert distance_m(*a, *b) == pytest.approx(metres, rel=0.01)
    assert bearing_deg(*a, *b) == pytest.approx(bearing, abs=1)


@given(LATITUDES, LONGITUDES, LATITUDES, LONGITUDES)
def test_any_two_places(a, b, c, d):
    distance = distance_m(a, b, c, d)
    assert 0 <= distance <= 20_100_000
    assert distance == pytest.approx(distance_m(c, d, a, b), abs=0.01)
    assert 0 <= bearing_deg(a, b, c, d) < 360


@given(st.floats(-1e6, 1e6))
def test_a_compass_never_shows_360(angle):
    shown = compass_deg(angle)
    assert 0 <= shown < 360
    assert math.isclose(math.cos(math.radians(shown)), math.cos(math.radians(angle)), abs_tol=1e-6)


def test_a_hair_west_of_north():
    assert compass_deg(-1e-17) == 0.0
