"""LAND in closed loop with a point mass in wind, and what it never does."""

import math
from dataclasses import replace

import pytest

from raspilot.flight_modes.land import Land
from raspilot.navigation.approach import approach_airspeed_m_s
from tests.raspilot.flight_modes.mode_rig import ModeRig, bound
from tests.raspilot.navigation.point_mass import CONFIG, PointMass
from up.config import ConfigErrors
from up.flight_modes.demand import AttitudeDemand, Circle, Course, Line, PathDemand
from up.flight_modes.flight_mode import Home, Target
from up.flight_modes.navigation_state import Point
from up.flight_modes.selector import DemandError

HOME = Home(Point(0.0, 0.0), 250.0)
SPEEDS = CONFIG.airspeed


class Runway(ModeRig):
    """Flies until the ground, or for ``longest_s``; ``seen`` changes the estimate."""

    seen = {}

    @property
    def situation(self):
        situation = super().situation
        if situation.navigation is None:
            return situation
        return replace(situation, navigation=replace(situation.navigation, **self.seen))

    def land(self, longest_s=300.0):
        while self.plane.altitude > 250.0 and self.plane.time_s < longest_s:
            self.fly(0.02)
        return self.plane.track[-1]

    def until(self, path, longest_s=300.0):
        """Fly until the demand has a path of this class, and return it."""
        while self.plane.time_s < longest_s:
            self.fly(0.02)
            last = self.demands[-1]
            if isinstance(last, PathDemand) and isinstance(last.path, path):
                return last
        raise AssertionError(f"never {path.__name__}")


SMALL = "{radius_m: 30, height_m: 16}"


def runway(tmp_path, wind=(-4.0, 0.0), land=SMALL, home=HOME, **plane):
    values = {"north": 60.0, "altitude": 270.0, **plane}
    rig = Runway(bound(Land, tmp_path, land=land), PointMass(wind=wind, **values), home=home)
    return rig.enter()


@pytest.mark.parametrize("wind", [(0.0, 0.0), (-4.0, 0.0), (5.0, 5.0)])
def test_it_lands_at_home_against_the_wind_with_the_motor_off_and_level_wings(tmp_path, wind):
    rig = runway(tmp_path, wind)
    assert rig.mode.refusal(rig.situation) is None
    down = rig.land()
    assert math.hypot(*down.position) < 12.0
    assert -1.2 < down.climb_m_s < -0.4
    assert abs(down.roll_deg) < 3.0
    if any(wind):
        upwind = math.degrees(math.atan2(-wind[1], -wind[0]))
        assert abs(math.remainder(down.course_deg - upwind, 360.0)) < 3.0
    assert min(each.airspeed_m_s for each in rig.plane.track) > 1.2 * SPEEDS.stall_m_s
    first = next(n for n, each in enumerate(rig.demands) if not each.motor)
    assert rig.plane.track[first].altitude_m == pytest.approx(257.0, abs=1.5)
    assert not any(each.motor for each in rig.demands[first:]), "below the decision it stays off"
    assert rig.plane.attitude.throttle == 0.0


def test_it_lands_at_the_target_whose_altitude_is_that_of_the_ground(tmp_path):
    target = Target(Point(60.0, 40.0), 262.0)
    mode = bound(Land, tmp_path, land=SMALL)
    rig = Runway(mode, PointMass(altitude=280.0), home=HOME, target=target)
    rig.enter()
    while rig.plane.altitude > 262.0 and rig.plane.time_s < 300.0:
        rig.fly(0.02)
    assert math.dist(rig.plane.track[-1].position, target.point) < 12.0
    assert rig.mode.goal == target


def test_a_new_target_is_followed_while_it_circles(tmp_path):
    rig = runway(tmp_path)
    rig.fly(2.0)
    assert rig.path_demand.path.centre == HOME.point
    rig.given["target"] = Target(Point(400.0, 0.0), 251.0)
    rig.fly(0.1)
    assert rig.path_demand.path.centre == Point(400.0, 0.0)
    assert rig.path_demand.altitude_m == pytest.approx(267.0)


@pytest.mark.parametrize("error_m", [-5.0, 5.0])
def test_a_wrong_height_moves_the_touchdown_but_not_its_sink(tmp_path, error_m):
    rig = runway(tmp_path, home=Home(Point(0.0, 0.0), 250.0 - error_m))
    down = rig.land()
    assert -1.2 < down.climb_m_s < -0.4
    assert abs(down.roll_deg) < 3.0
    assert not rig.demands[-1].motor
    assert 20.0 < math.hypot(*down.position) < 60.0


def final(tmp_path, **more):
    rig = runway(tmp_path, **more)
    rig.until(Line)
    return rig


@pytest.mark.parametrize(
    ("height", "east", "up"), [(7.4, 15.0, 0.0), (8.5, 0.0, 12.0), (14.0, 0.0, -7.5)]
)
def test_an_approach_that_is_not_as_planned_is_flown_again(tmp_path, height, east, up):
    rig = final(tmp_path)
    plane = rig.plane
    while plane.altitude > 250.0 + height:
        rig.fly(0.02)
    plane.east += east
    plane.altitude += up
    began_s = plane.time_s
    again = rig.until(Circle, began_s + 60.0)
    assert again.motor and again.path.centre == HOME.point
    down = rig.land(600.0)
    assert math.hypot(*down.position) < 12.0


def test_without_thrust_there_is_no_second_approach(tmp_path):
    rig = final(tmp_path)
    while rig.plane.altitude > 257.4:
        rig.fly(0.02)
    rig.plane.east += 15.0
    rig.plane.motor_stopped, rig.plane.thrust = True, 0.0
    begin = len(rig.demands)
    rig.land()
    assert rig.plane.altitude <= 250.0
    assert all(isinstance(each.path, Line) for each in rig.demands[begin:])
    assert not rig.demands[-1].motor


def test_near_the_ground_the_bank_is_limited_by_the_height_that_is_certain(tmp_path):
    rig = runway(tmp_path)
    mode, situation = rig.mode, rig.situation
    limits = {}
    for height_m, sd_m in ((25.0, 3.0), (6.0, 3.0), (2.0, 3.0), (25.0, 25.0)):
        state = replace(situation.navigation, altitude_m=250.0 + height_m, altitude_sd_m=sd_m)
        demand = mode.step(replace(situation, navigation=state), 0.02)
        limits[height_m, sd_m] = demand.bank_limit_deg
    assert limits == {(25.0, 3.0): 96.0, (6.0, 3.0): 20.0, (2.0, 3.0): 8.0, (25.0, 25.0): 8.0}
    final_rig = final(tmp_path)
    assert final_rig.path_demand.bank_limit_deg == 25.0


def test_entered_below_the_decision_height_it_glides_straight_on(tmp_path):
    """So a restart of the program on the ground, or in the last seconds, starts no motor."""
    rig = runway(tmp_path, altitude=255.0, heading=10.0)
    down = rig.land()
    assert not any(each.motor for each in rig.demands)
    assert rig.demands[0].path == Course(0.0)
    assert down.altitude_m <= 250.0


def test_after_touchdown_the_throttle_stays_closed(tmp_path):
    rig = runway(tmp_path)
    rig.fly(1.0)
    rig.seen = {"is_in_flight": False}
    rig.fly(1.0)
    assert rig.demands[-1] == AttitudeDemand(0.0, 0.0, 0.0)
    rig.seen = {}
    rig.fly(1.0)
    assert rig.demands[-1] == AttitudeDemand(0.0, 0.0, 0.0), "whatever the fixes show later"


def test_without_a_fix_the_fallback_acts_until_the_decision_and_never_after_it(tmp_path):
    rig = final(tmp_path)
    rig.seen = {"fix_age_s": 3.5}
    with pytest.raises(DemandError) as caught:
        rig.mode.step(rig.situation, 0.02)
    assert caught.value.code == "navigation"
    rig.seen = {}
    while rig.plane.altitude > 256.0:
        rig.fly(0.02)
    rig.seen = {"fix_age_s": 3.5}
    assert not rig.mode.step(rig.situation, 0.02).motor
    rig.has_navigation = False
    level = rig.mode.step(rig.situation, 0.02)
    assert (level.roll_deg, level.throttle) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("home", "target", "plane", "code"),
    [
        (None, None, {}, "no_home"),
        (None, Target(Point(0.0, 0.0), 250.0), {}, "no_home"),
        (Home(Point(1e7, 0.0), 250.0), None, {}, "home_too_far"),
        (HOME, Target(Point(0.0, 1e7), 250.0), {}, "target_too_far"),
        (HOME, Target(Point(0.0, 0.0), 281.0), {}, "target_too_high"),
        (HOME, Target(Point(0.0, 0.0), 219.0), {}, "target_too_low"),
        (HOME, None, {"wind": (9.0, 0.0)}, "wind_too_strong"),
    ],
)
def test_it_refuses(tmp_path, home, target, plane, code):
    rig = Runway(bound(Land, tmp_path), PointMass(**plane), home=home, target=target)
    assert rig.mode.refusal(rig.situation).code == code


def test_it_refuses_on_the_ground_and_without_a_fresh_fix(tmp_path):
    rig = Runway(bound(Land, tmp_path), home=HOME)
    rig.seen = {"is_in_flight": False}
    assert rig.mode.refusal(rig.situation).code == "on_ground"
    rig.seen = {"fix_age_s": 3.5}
    assert rig.mode.refusal(rig.situation).code == "navigation"


def test_the_approach_is_faster_in_wind_and_within_the_limits():
    assert approach_airspeed_m_s(CONFIG, 0.0) == pytest.approx(1.3 * SPEEDS.stall_m_s)
    assert approach_airspeed_m_s(CONFIG, 4.0) == pytest.approx(1.3 * SPEEDS.stall_m_s + 1.0)
    assert approach_airspeed_m_s(CONFIG, 40.0) == SPEEDS.maximum_m_s


def test_a_circle_below_the_decision_height_is_refused_by_its_configuration(tmp_path):
    with pytest.raises(ConfigErrors):
        runway(tmp_path, land="{height_m: 12, decision_height_m: 10.5}")
