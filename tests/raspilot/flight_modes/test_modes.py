"""The modes in closed loop with a point mass in wind, and their refusals."""

import math
from dataclasses import replace

import pytest
from twisted.internet.task import Clock

from raspilot.flight_modes.acro import Acro
from raspilot.flight_modes.circle import CircleMode
from raspilot.flight_modes.cruise import Cruise
from raspilot.flight_modes.fbw import FlyByWire
from raspilot.flight_modes.glide import Glide
from raspilot.flight_modes.guided import Guided
from raspilot.flight_modes.loiter import Loiter
from raspilot.flight_modes.return_home import Return
from tests.raspilot.flight_modes.mode_rig import ModeRig, bound, sticks
from tests.raspilot.navigation.point_mass import CONFIG, PointMass, distances, rms
from tests.support.system import build_up
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.flight_modes.demand import AttitudeDemand, Bank, Line, SurfacesDemand
from up.flight_modes.flight_mode import Home, Target
from up.flight_modes.navigation_state import Point

HOME = Home(Point(0.0, 0.0), 250.0)
SPEEDS = CONFIG.airspeed


@pytest.mark.parametrize(("roll", "is_clockwise"), [(15.0, True), (-15.0, False)])
def test_loiter_circles_where_it_was_entered(tmp_path, roll, is_clockwise):
    plane = PointMass(wind=(0.0, 4.0), north=200.0, roll=roll)
    rig = ModeRig(bound(Loiter, tmp_path), plane).enter()
    circle = rig.mode.step(rig.situation, 0.02).path
    assert circle.is_clockwise is is_clockwise
    assert abs(math.dist(circle.centre, (200.0, 0.0)) - circle.radius_m) < 5.0
    # From the beginning: it enters the circle along its tangent.
    assert rms(each - 50.0 for each in distances(rig.fly(60), circle.centre)) < 2.5


def test_loiter_changes_its_altitude_on_request(tmp_path):
    rig = ModeRig(bound(Loiter, tmp_path, loiter="radius_m: 30")).enter()
    rig.fly(20)
    assert rig.path_demand.path.radius_m == 30.0
    assert rig.plane.altitude == pytest.approx(300.0, abs=1.0)
    rig.given["required_altitude_m"] = 320.0
    assert rig.fly(30)[-1].altitude_m == pytest.approx(320.0, abs=1.0)


def test_a_circle_that_the_wind_does_not_permit_is_wider(tmp_path):
    plane = PointMass(wind=(8.0, 0.0))
    rig = ModeRig(bound(Loiter, tmp_path, loiter="radius_m: 15"), plane).enter()
    rig.fly(20)
    circle = rig.path_demand.path
    assert circle.radius_m > 50.0
    assert rms(each - circle.radius_m for each in distances(rig.fly(60), circle.centre)) < 1.5
    assert max(abs(each.roll_deg) for each in plane.track) < CONFIG.lateral.bank_limit_deg


def test_cruise_holds_course_and_altitude_in_wind(tmp_path):
    plane = PointMass(wind=(0.0, 6.0), heading=-33.0)
    rig = ModeRig(bound(Cruise, tmp_path), plane).enter()
    course = plane.state.course_deg
    track = rig.fly(40)
    assert track[-1].course_deg == pytest.approx(course, abs=1.0)
    assert track[-1].altitude_m == pytest.approx(300.0, abs=0.5)


def test_cruise_follows_requests_until_the_sticks_change_them(tmp_path):
    rig = ModeRig(bound(Cruise, tmp_path), rx=sticks()).enter()
    rig.fly(3)
    rig.given.update(required_course_deg=200.0, required_altitude_m=315.0)
    track = rig.fly(40)
    assert track[-1].course_deg == pytest.approx(200.0, abs=1.0)
    assert track[-1].altitude_m == pytest.approx(315.0, abs=1.0)
    rig.given["rx"] = sticks(ailerons=1750, elevator=1900)
    rig.fly(4)
    assert rig.path_demand.path == Bank(CONFIG.lateral.bank_limit_deg / 2)
    assert rig.plane.state.climb_m_s > 1.0
    rig.given["rx"] = sticks()
    begin = rig.plane.altitude
    track = rig.fly(30)
    assert abs(math.remainder(track[-1].course_deg - 200.0, 360.0)) > 20.0
    assert rms(each.course_deg - track[-1].course_deg for each in track[-500:]) < 1.0
    assert track[-1].altitude_m == pytest.approx(begin, abs=1.0)
    assert isinstance(rig.path_demand.path, Line)


def test_guided_flies_to_the_target_and_circles_there(tmp_path):
    plane = PointMass(wind=(3.0, 3.0))
    target = Target(Point(600.0, -200.0), 330.0, 40.0)
    rig = ModeRig(bound(Guided, tmp_path), plane, target=target, home=HOME)
    assert rig.mode.refusal(rig.situation) is None
    rig.enter().fly(90)
    track = rig.fly(40)
    assert rms(each - 40.0 for each in distances(track, target.point)) < 1.0
    assert track[-1].altitude_m == pytest.approx(330.0, abs=0.5)
    rig.given["target"] = replace(target, point=Point(1e7, 0.0))
    rig.fly(1)
    assert rig.path_demand.path.centre == target.point
    rig.given["target"] = replace(target, point=Point(0.0, 0.0), radius_m=None)
    rig.fly(1)
    assert rig.path_demand.path.centre == Point(0.0, 0.0)
    assert rig.path_demand.path.radius_m == 50.0


@pytest.mark.parametrize(
    ("target", "code"),
    [
        (None, "no_target"),
        (Target(Point(1e7, 0.0), 300.0), "target_too_far"),
        (Target(Point(1.0, 0.0), 9000.0), "target_too_high"),
        (Target(Point(1.0, 0.0), -9000.0), "target_too_low"),
        (Target(Point(1.0, 0.0), 240.0), "target_below_home"),
        (Target(Point(1.0, 0.0), 300.0, -5.0), "target_radius"),
    ],
)
def test_guided_refuses_a_bad_target(tmp_path, target, code):
    rig = ModeRig(bound(Guided, tmp_path), target=target, home=HOME)
    assert rig.mode.refusal(rig.situation).code == code


@pytest.mark.parametrize(
    ("home", "code"),
    [
        (None, "no_home"),
        (Home(Point(1e7, 0.0), 250.0), "home_too_far"),
    ],
)
def test_return_refuses_without_a_home_in_reach(tmp_path, home, code):
    rig = ModeRig(bound(Return, tmp_path), home=home)
    assert rig.mode.refusal(rig.situation).code == code


def test_return_climbs_flies_home_and_circles_there(tmp_path):
    plane = PointMass(wind=(-4.0, 0.0), north=-400.0, heading=180.0, altitude=280.0)
    rig = ModeRig(bound(Return, tmp_path), plane, home=HOME)
    assert rig.mode.refusal(rig.situation) is None
    track = rig.enter().fly(110)
    assert min(each.altitude_m for each in track) > 279.0
    arrived = next(each for each in track if math.hypot(*each.position) < 100.0)
    assert arrived.altitude_m == pytest.approx(310.0, abs=1.5)
    track = rig.fly(40)
    assert rms(each - 50.0 for each in distances(track)) < 1.0
    assert track[-1].altitude_m == pytest.approx(310.0, abs=0.5)


@pytest.mark.parametrize(("land", "successor"), [("false", ""), ("true", "LAND")])
def test_return_lands_at_home_if_it_is_configured(tmp_path, land, successor):
    plane = PointMass(north=-150.0, altitude=310.0)
    rig = ModeRig(bound(Return, tmp_path, **{"return": f"land: {land}"}), plane, home=HOME).enter()
    rig.fly(0.5)
    assert rig.mode.successor == ""
    rig.fly(8.0)
    assert rig.mode.successor == successor


def test_return_from_above_descends_only_at_home(tmp_path):
    plane = PointMass(north=-500.0, altitude=400.0)
    rig = ModeRig(bound(Return, tmp_path), plane, home=HOME).enter()
    track = rig.fly(30)
    assert track[-1].altitude_m == pytest.approx(400.0, abs=1.0)
    assert rig.fly(120)[-1].altitude_m == pytest.approx(310.0, abs=1.0)


def test_return_flies_faster_against_a_strong_wind(tmp_path):
    """70 % of the cruise airspeed against it, from 1 km: at cruise it would take 300 s."""
    plane = PointMass(wind=(-7.7, 0.0), north=-1000.0, altitude=320.0)
    rig = ModeRig(bound(Return, tmp_path), plane, home=HOME).enter()
    track = rig.fly(200)
    arrived = next(each for each in track if math.hypot(*each.position) < 100.0)
    assert arrived.time_s < 190.0
    assert max(each.airspeed_m_s for each in track) > 12.5
    assert min(each.airspeed_m_s for each in track) > 1.2 * SPEEDS.stall_m_s
    assert min(each.altitude_m for each in track) > 305.0


def test_return_follows_a_home_that_is_moved(tmp_path):
    rig = ModeRig(bound(Return, tmp_path), home=HOME).enter()
    rig.fly(2)
    rig.given["home"] = Home(Point(300.0, 0.0), 250.0)
    rig.fly(0.1)
    assert rig.path_demand.path.centre == Point(300.0, 0.0)


def test_circle_holds_the_altitude_while_it_is_known(tmp_path):
    rig = ModeRig(bound(CircleMode, tmp_path)).enter()
    track = rig.fly(30)
    assert track[-1].roll_deg == pytest.approx(20.0, abs=0.5)
    assert track[-1].altitude_m == pytest.approx(300.0, abs=0.5)
    rig.has_navigation = False
    track = rig.fly(30)
    assert rig.demands[-1].throttle == 0.0
    assert track[-1].roll_deg == pytest.approx(20.0, abs=0.5)
    assert min(each.airspeed_m_s for each in track) > 1.2 * SPEEDS.stall_m_s
    assert -1.2 < track[-1].climb_m_s < -0.4


def test_circle_glides_while_the_altitude_is_too_uncertain(tmp_path):
    rig = ModeRig(bound(CircleMode, tmp_path)).enter()
    situation = rig.situation
    guess = replace(situation.navigation, fix_age_s=20.0, altitude_sd_m=24.0)
    assert rig.mode.step(replace(situation, navigation=guess), 0.02).altitude_m == 300.0
    guess = replace(guess, altitude_sd_m=26.0)
    assert rig.mode.step(replace(situation, navigation=guess), 0.02).throttle == 0.0


def test_glide_goes_home_with_the_motor_off(tmp_path):
    plane = PointMass(wind=(-3.0, 0.0), north=-300.0, altitude=400.0, heading=90.0)
    rig = ModeRig(bound(Glide, tmp_path), plane, home=HOME).enter()
    track = rig.fly(110)
    assert rms(each - 50.0 for each in distances(track[-500:])) < 2.0
    assert plane.attitude.throttle == 0.0
    assert min(each.airspeed_m_s for each in track) > 1.1 * SPEEDS.stall_m_s
    assert track[-1].altitude_m > 300.0


@pytest.mark.parametrize("has_navigation", [True, False])
def test_glide_turns_gently_without_a_home(tmp_path, has_navigation):
    rig = ModeRig(bound(Glide, tmp_path), has_navigation=has_navigation).enter()
    track = rig.fly(40)
    assert track[-1].roll_deg == pytest.approx(10.0, abs=0.5)
    assert rig.demands[-1] != rig.demands[0] or rig.plane.attitude.throttle == 0.0
    assert track[-1].airspeed_m_s == pytest.approx(8.05, abs=0.4)
    assert -0.9 < track[-1].climb_m_s < -0.4


def test_fly_by_wire_takes_the_limits_of_the_airframe(tmp_path):
    config = {"config.yml": "flight controller: raspberry\n"}
    up = build_up((FlyByWire,), Clock(), tmp_path, config=config)
    mode = up.get_module(FlyByWire)
    rig = ModeRig(mode, rx=sticks(2000, 1000, 1600))
    assert mode.step(rig.situation, 0.02) == AttitudeDemand(50.0, -25.0, None, 1600)
    limits = FlyByWireLimitsCommand(40.0, 15.0, None)
    up.command_executor.execute_command(limits, Origin("arduino", Role.BOARD, 10))
    assert mode.step(rig.situation, 0.02) == AttitudeDemand(40.0, -25.0, None, 1600)


def test_acro_passes_the_sticks_through(tmp_path):
    rig = ModeRig(bound(Acro, tmp_path), rx=sticks(1700, 1300, 1550))
    assert rig.mode.step(rig.situation, 0.02) == SurfacesDemand(1700, 1300, 1550)
