from dataclasses import replace

from raspilot.failsafe.progress import ProgressWatch
from tests.raspilot.navigation_rig import NAVIGATION
from up.flight_modes.demand import Course, Line, PathDemand
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.navigation_state import Point

EAST = Line(Point(0.0, 1000.0), 90.0)


def test_towards_the_end_of_a_line():
    watch = ProgressWatch(NavigationConfig())

    def stalled_s(now_s, east_m, path=EAST):
        return watch.stalled_s(
            now_s, PathDemand(path), replace(NAVIGATION, position=Point(50.0, east_m))
        )

    assert stalled_s(0.0, 0.0) == 0.0
    assert stalled_s(20.0, 5.0) == 20.0, "5 m in 20 s are no progress"
    assert stalled_s(30.0, 11.0) == 0.0
    assert stalled_s(50.0, -200.0) == 20.0, "it is blown back"
    assert stalled_s(60.0, -200.0, Line(Point(0.0, 900.0), 90.0)) == 0.0, "the next waypoint"
    assert stalled_s(70.0, -200.0, Course(90.0)) == 0.0, "it ends nowhere"
    assert stalled_s(80.0, 1001.0) == 0.0, "it is there"
