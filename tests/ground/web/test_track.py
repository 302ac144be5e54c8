import pytest

from up.protocols.general_message import GeneralMessage
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.track import POINTS_LIMIT, Track

STEP_DEG = 0.0001


class _Flight:
    """Flies north, and reports a position each time."""

    def __init__(self) -> None:
        self.track = Track()
        self.now_s = 0.0
        self._telemetry = Telemetry()
        self._places = 0

    def fly(self, times, period_s=0.1, aboard_ms=100, is_moving=True):
        for _ in range(times):
            self.now_s += period_s
            self._places += is_moving
            location = {"latitude": 50.0 + self._places * STEP_DEG, "longitude": 8.0}
            data = {"location": location, "age_ms": {"location": aboard_ms}}
            self._telemetry.update(GeneralMessage(NAME, data, None, None), self.now_s)
            self.track.update(self._telemetry, self.now_s)

    @property
    def breaks(self):
        return [place for place, point in enumerate(self.track.points()) if point[3:] == (True,)]


@pytest.fixture
def flight():
    return _Flight()


def test_an_even_way_is_one_line(flight):
    flight.fly(50)
    assert flight.breaks == []
    assert all(len(point) == 3 for point in flight.track.points())


def test_no_line_leads_across_a_silence(flight):
    flight.fly(20)
    flight.now_s += 6
    flight.fly(20)
    assert flight.breaks == [20]


def test_a_phone_that_tells_no_place_is_a_silence_though_frames_come(flight):
    flight.fly(20)
    flight.fly(60, aboard_ms=4000, is_moving=False)
    flight.fly(20)
    assert flight.breaks == [20]


def test_a_place_every_five_seconds_is_no_silence(flight):
    flight.fly(20, period_s=5.0)
    assert set(flight.breaks) <= set(range(1, 6))
    assert flight.breaks[-1:] != [19]


def test_a_silence_outlives_the_thinning_of_many_points(flight):
    flight.fly(1001)
    flight.now_s += 6
    flight.fly(POINTS_LIMIT - 1001)
    points = flight.track.points()
    assert len(points) < POINTS_LIMIT
    assert len(flight.breaks) == 1
    (place,) = flight.breaks
    before_deg, after_deg = points[place - 1][0], points[place][0]
    assert before_deg < 50.0 + 1001.5 * STEP_DEG < after_deg + STEP_DEG / 10
