"""MISSION in closed loop: what the point mass flies."""

import math
from dataclasses import replace

import pytest

from raspilot.flight_modes.land import Land
from raspilot.flight_modes.mission import Mission
from raspilot.flight_modes.takeoff import Takeoff
from tests.raspilot.mission.mission_rig import HOME, MissionRig
from tests.raspilot.mission.plans_rig import PlansRig, placed
from tests.raspilot.navigation.point_mass import PointMass, distances, rms
from tests.raspilot.navigation_rig import NAVIGATION, STANDING, refusal
from up.commands.flight_state_command import FlightModeCommand
from up.commands.mission_commands import MissionItemCommand
from up.commands.navigation_commands import HomeCommand
from up.flight_modes.demand import AttitudeDemand, Circle
from up.flight_modes.navigation_state import Point
from up.flight_modes.selector import DemandError

NORTH, EAST = placed(300, 0), placed(300, 300)
END = placed(0, 300, kind="loiter", radius=60)


def aside(track, item, rig, line):
    """Return how far from its line an item was flown, once the turn onto it was over."""
    times = [state.time_s for number, state in rig.passed if number in (item - 1, item)]
    return [line(each) for each in track if times[0] + 8 < each.time_s < times[1]]


class TestLines:
    """Waypoints and the corners between them."""

    @pytest.mark.parametrize("wind", [(0.0, 0.0), (0.0, 6.0)])
    def test_it_flies_the_lines_inside_the_corners_and_circles_at_the_end(self, tmp_path, wind):
        rig = MissionRig(tmp_path, [NORTH, EAST, END], PointMass(wind=wind)).enter()
        track = rig.fly(135)
        assert rig.order == [1, 2]
        assert rms(aside(track, 2, rig, lambda each: each.position.north_m - 300)) < 3
        assert max(each.position.north_m for each in track) < 310
        nearest = min(distances(track, (300, 0)))
        assert 5 < nearest < 40, "it turns inside the corner"
        assert 45 < distances(track, (0, 300))[-1] < 75

    def test_over_passes_over_the_point(self, tmp_path):
        over = [{**NORTH, "over": True}, EAST, END]
        rig = MissionRig(tmp_path, over, PointMass(wind=(0.0, 4.0))).enter()
        assert min(distances(rig.fly(32), (300, 0))) < 3
        assert rig.order == [1]

    def test_it_climbs_at_once_and_descends_along_the_line(self, tmp_path):
        items = [placed(300, 0, altitude=80.0), placed(300, 400, altitude=56.0), END]
        rig = MissionRig(tmp_path, items).enter()
        track = rig.fly(64)
        half = next(each for each in track if each.position.north_m > 200)
        assert half.altitude_m == pytest.approx(330, abs=3), "home is at 250"
        corner, end = rig.passed[0][1], rig.passed[1][1]
        middle = next(each for each in track if each.position.east_m > 200)
        assert middle.altitude_m == pytest.approx(317, abs=4)
        assert corner.altitude_m == pytest.approx(330, abs=3)
        assert end.altitude_m == pytest.approx(306, abs=3)

    def test_the_airspeed_is_that_of_the_speed_before_it(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, {"kind": "speed", "airspeed": 14.0}, EAST, END]).enter()
        rig.fly(5)
        assert rig.path_demand.airspeed_m_s is None
        track = rig.fly(40)
        assert rig.plans.progress.item == 3
        assert track[-1].airspeed_m_s == pytest.approx(14, abs=0.6)

    def test_the_last_waypoint_is_circled(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH]).enter()
        track = rig.fly(70)
        assert rig.plans.progress.is_finished
        assert rig.plans.telemetry_content["mission"]["is_finished"] is True
        assert all(40 < each < 60 for each in distances(track[-500:], (300, 0)))
        assert rig.path_demand.altitude_m == 310


class TestCircles:
    """Loiter items, and how they end."""

    def test_turns_are_counted_on_the_circle_and_it_leaves_towards_the_next(self, tmp_path):
        one = placed(150, 0, kind="loiter_turns", turns=1, radius=50, clockwise=False)
        rig = MissionRig(tmp_path, [one, placed(150, 400), END]).enter()
        rig.fly(72)
        assert rig.order == [1]
        (_, left), arrived = rig.passed[0], 100 / 11
        turns = (left.time_s - arrived) * 11 / (2 * math.pi * 50)
        assert 0.9 < turns < 2.1
        assert left.course_deg == pytest.approx(90, abs=25)
        assert left.position.north_m < 150, "counter-clockwise it leaves to the east on the south"

    def test_time_ends_only_at_the_altitude(self, tmp_path):
        wait = placed(100, 0, kind="loiter_time", time=1, altitude=115.0, radius=60)
        rig = MissionRig(tmp_path, [wait, placed(300, 400, altitude=110.0), END]).enter()
        rig.fly(60)
        assert rig.order == [1]
        assert rig.passed[0][1].altitude_m > 250 + 115 - 10.5
        assert rig.passed[0][1].time_s > 20

    def test_an_endless_one_stays(self, tmp_path):
        rig = MissionRig(tmp_path, [placed(0, 100, kind="loiter", radius=60)]).enter()
        rig.fly(60)
        assert rig.order == []
        assert rig.plans.progress.is_finished is False
        assert rig.path_demand.path == Circle(rig.path_demand.path.centre, 60.0, True)


class TestOrder:
    """Jumps, the ground's choice, and changes on the way."""

    def test_a_jump_is_made_as_often_as_it_says(self, tmp_path):
        loop = {"kind": "jump", "item": 1, "repeat": 2}
        rig = MissionRig(tmp_path, [placed(120, 0), placed(0, 120), loop, END]).enter()
        rig.fly(100)
        assert rig.order == [1, 2, 1, 2, 1, 2]
        assert rig.plans.progress.item == 4

    def test_the_ground_selects_an_item_on_the_way(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END]).enter()
        rig.fly(3)
        assert rig.plans_rig.outcome(MissionItemCommand(3)) == [None]
        rig.fly(0.1)
        assert isinstance(rig.path_demand.path, Circle)

    def test_a_new_mission_begins_at_its_first_item(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END]).enter()
        rig.fly(35)
        assert rig.order == [1]
        assert rig.plans_rig.upload([placed(500, 500), END]) == [None]
        rig.fly(0.1)
        assert rig.plans.progress.item == 1
        assert rig.path_demand.path.point == pytest.approx((500, 500), abs=0.1)

    def test_without_a_mission_any_more_its_fallback_acts(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, END]).enter()
        rig.fly(1)
        assert rig.plans_rig.commit([]) == [None]
        with pytest.raises(DemandError) as refused:
            rig.fly(0.1)
        assert refused.value.code == "no_mission"


class TestRefusal:
    """When MISSION cannot be entered."""

    def test_each_reason_has_its_code(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END])
        situation, mode = rig.situation, rig.mode
        assert mode.refusal(situation) is None
        assert mode.refusal(replace(situation, home=None)).code == "no_home"
        assert mode.refusal(replace(situation, navigation=None)).code == "navigation"
        rig.plans_rig.commit([])
        assert mode.refusal(situation).code == "no_mission"

    def test_the_way_to_the_first_item_must_be_inside_the_fence(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END])
        lake = placed(150, 0)
        walls = [{"latitude": lake["latitude"], "longitude": lake["longitude"], "radius": 60.0,
                  "inside": False}]  # fmt: skip
        assert rig.plans_rig.upload(walls, "fence") == [None], "no leg crosses it"
        assert rig.mode.refusal(rig.situation).code == "mission_invalid"
        rig.plane.east = 250.0
        assert rig.mode.refusal(rig.situation) is None

    def test_a_home_from_which_it_cannot_be_flown_forbids_it(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END])
        again = PlansRig(tmp_path, (Mission,), gains=None)
        again.state(in_flight=False)
        again.navigation.set(replace(STANDING, position=Point(0.0, 0.0)))
        again.frame()
        again.plans.on_period()
        again.settle()
        assert again.plans.problems == []
        assert again.outcome(HomeCommand(48.2, 17.0)) == [None]
        again.plans.on_period()
        again.settle()
        assert {each.code for each in again.plans.problems} == {"too_far"}
        assert again.up.get_module(Mission).refusal(rig.situation).code == "mission_invalid"


class TestOtherModes:
    """takeoff, land and return are flown by the modes of these names."""

    def manager(self, folder, data):
        rig = PlansRig(folder, (Mission, Land, Takeoff), gains=None)
        rig.state(in_flight=False)
        rig.navigation.set(replace(STANDING, position=HOME.point, is_in_flight=False))
        rig.frame()
        assert rig.upload(data) == [None], rig.ground.sent
        rig.plans.on_period()
        rig.settle()
        return rig

    def test_return_and_land_replace_it(self, tmp_path):
        land = placed(0, 100, kind="land", altitude=0.0)
        for data, name in (([NORTH, {"kind": "return"}], "RETURN"), ([NORTH, land], "LAND")):
            rig = self.manager(tmp_path, data)
            rig.state()
            rig.navigation.set(replace(NAVIGATION, altitude_m=310.0))
            rig.frame()
            assert rig.outcome(FlightModeCommand("MISSION")) == [None]
            rig.setpoint()
            assert rig.shown()["mode"] == "MISSION"
            rig.outcome(MissionItemCommand(2))
            rig.setpoint()
            assert rig.shown()["selected"] == name
            rig.setpoint()
            assert rig.shown()["mode"] == name
        target = rig.manager.telemetry_content["navigation"]["target"]
        assert (target["longitude"], target["altitude"]) == (
            pytest.approx(land["longitude"]), pytest.approx(250)
        )  # fmt: skip

    def test_takeoff_holds_the_motor_and_comes_back(self, tmp_path):
        rig = self.manager(tmp_path, [{"kind": "takeoff", "altitude": 30.0}, NORTH, END])
        rig.state()
        rig.sticks(throttle=1500)
        assert refusal(rig.outcome(FlightModeCommand("MISSION"))) == "throttle_not_low"
        rig.sticks(throttle=1000)
        rig.frame()
        assert rig.outcome(FlightModeCommand("MISSION")) == [None]
        assert rig.setpoint().throttle_us == 1000
        assert rig.shown()["selected"] == "TAKEOFF"
        rig.setpoint()
        rig.sticks(throttle=1500)
        assert rig.setpoint().throttle_us == 1000, "in the hand"
        rig.navigation.set(NAVIGATION)
        assert rig.setpoint().throttle_us > 1500, "thrown"
        rig.navigation.set(replace(NAVIGATION, altitude_m=279.0))
        rig.setpoint()
        rig.setpoint()
        assert rig.shown()["mode"] == "MISSION"
        assert rig.plans.progress.item == 2

    def test_in_the_hand_it_demands_no_motor(self, tmp_path):
        takeoff = {"kind": "takeoff", "altitude": 30.0}
        rig = MissionRig(tmp_path, [takeoff, NORTH, END], modes=(Takeoff,))
        standing = replace(rig.situation.navigation, is_in_flight=False)
        situation = replace(rig.situation, navigation=standing)
        rig.mode.enter(situation)
        assert rig.mode.step(situation, 0.02) == AttitudeDemand(0.0, 0.0, 0.0)

    def test_in_flight_takeoff_is_a_climb_along_the_course(self, tmp_path):
        takeoff = {"kind": "takeoff", "altitude": 80.0}
        rig = MissionRig(tmp_path, [takeoff, NORTH, END], modes=(Takeoff,)).enter()
        track = rig.fly(14)
        assert rig.order == [1]
        assert rig.passed[0][1].altitude_m == pytest.approx(325, abs=1)
        assert abs(track[-1].position.east_m) < 5


class TestRestart:
    """The program is started again in flight."""

    def test_item_jumps_and_circle_go_on(self, tmp_path):
        items = [placed(100, 0, kind="loiter_turns", turns=1, radius=50),
                 {"kind": "jump", "item": 1, "repeat": 1}, placed(300, 300), END]  # fmt: skip
        rig = MissionRig(tmp_path, items).enter()
        rig.fly(46)
        assert rig.order == [], "the same item again"
        before = rig.plans.progress
        assert before.jumps == {"2": 1}
        assert before.turned_deg > 30
        rig.plans_rig.manager.home.memory.wait()
        again = MissionRig(tmp_path, items, rig.plane, is_new=False).enter()
        assert again.plans.progress == before
        track = again.fly(48)
        assert again.order == [1]
        assert again.plans.progress.item == 3, "no other jump"
        flown_s = again.passed[0][1].time_s - track[0].time_s
        assert flown_s < 35, "the rest of the turn, and the way to the exit"

    def test_the_line_is_the_same_although_the_aircraft_has_left_it(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END]).enter()
        rig.fly(32)
        assert rig.order == [1]
        rig.plans_rig.manager.home.memory.wait()
        rig.plane.north += 100
        again = MissionRig(tmp_path, [], rig.plane, is_new=False).enter()
        again.fly(0.1)
        assert again.path_demand.path.point == pytest.approx((300, 300), abs=0.1)
        assert again.path_demand.path.course_deg == pytest.approx(90, abs=0.1)

    def test_progress_of_another_mission_is_not_resumed(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END])
        rig.plans_rig.outcome(MissionItemCommand(3))
        memory = rig.plans_rig.manager.home.memory
        memory.update(mission=replace(rig.plans.progress, plan_id="other"))
        memory.wait()
        again = MissionRig(tmp_path, [], is_new=False)
        assert again.plans.progress.item == 1

    def test_the_mode_acts_again_as_soon_as_a_position_comes(self, tmp_path):
        rig = MissionRig(tmp_path, [NORTH, EAST, END]).plans_rig
        rig.navigation.set(replace(NAVIGATION, altitude_m=310.0))
        rig.frame()
        assert rig.outcome(FlightModeCommand("MISSION")) == [None]
        rig.setpoint()
        rig.outcome(MissionItemCommand(2))
        rig.manager.home.memory.wait()
        again = PlansRig(tmp_path, (Mission,), gains=None)
        again.state()
        assert again.setpoint()
        assert again.shown()["mode"] == "MISSION"
        assert again.plans.progress.item == 2
