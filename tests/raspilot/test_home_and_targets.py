"""The manager: home, and what the ground requests of a flight mode."""

from dataclasses import replace

import pytest
from twisted.logger import globalLogPublisher

from tests.raspilot.navigation_rig import (
    FRAME,
    NAVIGATION,
    STANDING,
    NavigationRig,
    flying_rig,
    refusal,
)
from up.commands.altitude_command import AltitudeCommand
from up.commands.flight_state_command import FlightModeCommand
from up.commands.heading_command import HeadingCommand
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.flight_modes.navigation_state import Point


@pytest.fixture
def rig(tmp_path):
    return flying_rig(tmp_path)


class TestHome:
    """Set once, moved by a Command only."""

    def home(self, rig):
        content = rig.manager.telemetry_content["home"]
        place = content["latitude"], content["longitude"]
        return None if place[0] is None else FRAME.point(*place)

    def test_the_first_accurate_position_then_the_one_where_the_flight_begins(self, tmp_path):
        rig = NavigationRig(tmp_path)
        rig.navigation.state = replace(NAVIGATION, position_sd_m=6.0)
        rig.state("FBW", armed=False, in_flight=False)
        rig.setpoint()
        assert self.home(rig) is None
        rig.navigation.state = STANDING
        rig.setpoint()
        assert self.home(rig) == pytest.approx((100.0, 50.0), abs=0.01)
        rig.navigation.state = replace(STANDING, position=Point(0.0, 10.0))
        rig.setpoint()
        assert self.home(rig) == pytest.approx((100.0, 50.0), abs=0.01)
        rig.state("FBW")
        rig.setpoint()
        assert self.home(rig) == pytest.approx((0.0, 10.0), abs=0.01)
        rig.navigation.state = replace(NAVIGATION, position=Point(900.0, 0.0))
        rig.setpoint()
        assert self.home(rig) == pytest.approx((0.0, 10.0), abs=0.01)
        assert rig.outcome(HomeCommand()) == [None]
        assert self.home(rig) == pytest.approx((900.0, 0.0), abs=0.01)

    @pytest.mark.parametrize(
        "at_arming", [{"position_sd_m": 6.0}, {"velocity_m_s": Point(12.0, 0.0)}]
    )
    def test_it_stays_when_the_flight_begins_without_a_fix_or_the_aircraft_arms_in_the_air(
        self, tmp_path, at_arming
    ):
        rig = NavigationRig(tmp_path)
        rig.state("FBW", armed=False, in_flight=False)
        rig.navigation.state = STANDING
        rig.setpoint()
        rig.navigation.state = replace(STANDING, position=Point(300.0, 0.0), **at_arming)
        rig.state("FBW")
        rig.setpoint()
        rig.navigation.state = replace(STANDING, position=Point(900.0, 0.0))
        rig.setpoint()
        assert self.home(rig) == pytest.approx((100.0, 50.0), abs=0.01)

    def test_a_command_that_changes_nothing_is_accepted_and_not_logged_again(self, rig):
        codes = []

        def observer(event):
            codes.append(event.get("code"))

        globalLogPublisher.addObserver(observer)
        try:
            for _ in range(300):
                assert rig.outcome(HomeCommand(48.0, 17.0)) == [None]
        finally:
            globalLogPublisher.removeObserver(observer)
        assert codes.count("home_set") <= 1

    def test_a_command_far_away_or_without_a_position_is_refused(self, tmp_path):
        rig = NavigationRig(tmp_path)
        assert refusal(rig.outcome(HomeCommand())) == "reading_stale"
        rig.setpoint()
        assert refusal(rig.outcome(HomeCommand(-48.0, 17.0))) == "too_far"

    def test_set_in_flight_without_an_altitude_it_keeps_that_of_the_ground(self, rig):
        rig.state()
        rig.navigation.state = replace(NAVIGATION, altitude_m=330.0)
        rig.setpoint()
        assert rig.outcome(HomeCommand()) == [None]
        assert rig.manager.home.place.altitude_m == 250.0

    def test_an_altitude_below_the_ground_of_home_is_refused(self, rig):
        """RETURN would fly to its height above it."""
        assert refusal(rig.outcome(HomeCommand(altitude_m=-1000.0))) == "home_altitude"
        assert refusal(rig.outcome(HomeCommand(48.0, 17.0, altitude_m=99.0))) == "home_altitude"
        assert rig.manager.home.place.altitude_m == 250.0
        assert rig.outcome(HomeCommand(altitude_m=205.0)) == [None]
        assert rig.manager.home.place.altitude_m == 205.0

    @pytest.mark.parametrize(
        ("wind", "time_s"),
        [((0.0, 0.0), 12.7), ((-4.0, 0.0), 20.0), ((0.0, 11.1), None), ((-11.0, 0.0), None)],
    )
    def test_the_time_home_counts_the_wind(self, rig, wind, time_s):
        rig.navigation.state = replace(
            NAVIGATION, position=Point(-40.0, 50.0), wind_m_s=Point(*wind)
        )
        rig.setpoint()
        shown = rig.manager.telemetry_content["home"]["time_s"]
        assert shown == (None if time_s is None else pytest.approx(time_s, rel=0.01))


class TestRequests:
    """The ground's target, course and altitude act, or are refused."""

    def test_guided_flies_to_the_target_which_is_shown_and_ends_with_the_mode(self, rig):
        rig.state()
        assert refusal(rig.outcome(FlightModeCommand("GUIDED"))) == "no_target"
        rig.outcome(NavigationTargetCommand(48.01, 17.0, height_m=80.0))
        rig.frame()
        assert rig.outcome(FlightModeCommand("GUIDED")) == [None]
        rig.setpoint()
        shown = rig.manager.telemetry_content["navigation"]["target"]
        assert shown == pytest.approx(
            {"latitude": 48.01, "longitude": 17.0, "altitude": 330.0, "radius": 50.0}
        )
        rig.outcome(FlightModeCommand("BANK"))
        rig.setpoint()
        shown = rig.manager.telemetry_content["navigation"]["target"]
        assert shown["latitude"] is None
        assert refusal(rig.outcome(FlightModeCommand("GUIDED"))) == "no_target"

    def test_a_target_ten_thousand_kilometres_away_is_refused(self, rig):
        assert refusal(rig.outcome(NavigationTargetCommand(-40.0, 17.0))) == "too_far"

    @pytest.mark.parametrize(
        ("altitude_m", "code"),
        [(-500.0, "target_too_low"), (4000.0, "target_too_high"), (249.0, "target_below_home")],
    )
    def test_an_impossible_target_or_altitude_is_refused_in_the_mode_that_would_fly_to_it(
        self, rig, altitude_m, code
    ):
        target = NavigationTargetCommand(48.01, 17.0, altitude_m=altitude_m)
        assert refusal(rig.outcome(target)) == code
        rig.state()
        rig.outcome(NavigationTargetCommand(48.01, 17.0, altitude_m=300.0))
        rig.frame()
        rig.outcome(FlightModeCommand("GUIDED"))
        rig.setpoint()
        assert refusal(rig.outcome(target)) == code
        rig.outcome(FlightModeCommand("LOITER"))
        rig.setpoint()
        assert refusal(rig.outcome(AltitudeCommand(altitude_m, "required"))) == code
        assert rig.manager.required("altitude") is None

    def test_a_required_altitude_is_shown_as_that_of_the_circle(self, rig):
        rig.state()
        rig.outcome(FlightModeCommand("LOITER"))
        rig.setpoint()
        assert rig.manager.telemetry_content["navigation"]["target"]["altitude"] == 250.0
        assert rig.outcome(AltitudeCommand(320.0, "required")) == [None]
        rig.setpoint()
        assert rig.manager.telemetry_content["navigation"]["target"]["altitude"] == 320.0

    def test_a_course_acts_in_a_mode_that_follows_it_and_is_shown(self, rig):
        required = HeadingCommand(-90.0, "required")
        assert refusal(rig.outcome(required)) == "mode_refused"
        rig.state()
        rig.outcome(FlightModeCommand("BANK"))
        rig.setpoint()
        assert rig.outcome(required) == [None]
        rig.setpoint()
        assert rig.bank.seen.required_course_deg == 270.0
        shown = rig.up.telemetry_controller.collect()["heading"]["required"]
        assert shown == 270.0
        assert refusal(rig.outcome(AltitudeCommand(100.0, "required"))) == "mode_refused"
        rig.outcome(FlightModeCommand("LEVEL"))
        assert rig.up.telemetry_controller.collect()["heading"]["required"] is None
