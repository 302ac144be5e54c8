"""The manager: selection by the ground, both placements, a successor, a restart in flight."""

from dataclasses import replace

import pytest

from raspilot.flight_modes.glide import Glide
from tests.raspilot.flight_controller_rig import BOARD, Rig
from tests.raspilot.navigation_rig import (
    FRAME,
    NAVIGATION,
    NavigationRig,
    flying_rig,
    refusal,
)
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.commands.navigation_commands import NavigationTargetCommand
from up.commands.output_command import SetpointCommand
from up.flight_modes.demand import Bank, Circle, PathDemand
from up.flight_modes.flight_mode import FlightMode, Target
from up.flight_modes.navigation_state import Point


@pytest.fixture
def rig(tmp_path):
    return flying_rig(tmp_path)


def test_a_mode_is_requested_of_the_board_first_and_acts_when_it_agrees(rig):
    done = rig.outcome(FlightModeCommand("BANK"))
    assert (done, rig.board.asked, rig.shown()["selected"]) == ([], ["AUTO"], None)
    assert rig.setpoint() is None
    rig.board.answer.callback(None)
    assert (done, rig.shown()["selected"]) == ([None], "BANK")
    assert rig.setpoint() == SetpointCommand(20.0, 5.0, throttle_us=1500)
    assert rig.shown()["mode"] is None, "the board does not follow yet"
    rig.state()
    assert (rig.shown()["mode"], rig.shown()["fallback"]) == ("BANK", None)


def test_nothing_is_selected_before_the_aircraft_is_armed(rig):
    rig.state("FBW", armed=False, in_flight=False)
    assert refusal(rig.outcome(FlightModeCommand("BANK"))) == "not_armed"


def test_where_the_board_flies_for_the_pi_a_mode_acts_at_once(rig):
    rig.state()
    assert rig.outcome(FlightModeCommand("BANK")) == [None]
    assert rig.setpoint().roll_deg == 20.0
    rig.outcome(FlightModeCommand("LEVEL"))
    assert rig.setpoint() == SetpointCommand(0.0, 0.0)


@pytest.mark.parametrize("controller", ["arduino", "raspberry"])
def test_without_the_receiver_set_points_are_marked_and_refused_unless_followed(
    tmp_path, controller
):
    rig = NavigationRig(tmp_path, f"flight controller: {controller}\n")
    lost = FlightStateCommand("FBW", True, False, True, True)
    rig.setpoint()
    for mode, outcome in (("FBW", "not_allowed"), ("RETURN", None)):
        rig.bus.execute_command(lost, BOARD)
        rig.setpoint()
        done = rig.outcome(FlightModeCommand("LEVEL"))
        assert rig.setpoint() == SetpointCommand(0.0, 0.0, is_failsafe=True)
        rig.bus.execute_command(replace(lost, flight_mode=mode), BOARD)
        rig.clock.advance(1.0)
        assert (refusal(done) if outcome else done[0]) == outcome
    assert rig.shown()["selected"] == "LEVEL"
    assert not rig.outputs


def test_the_arduinos_loop_takes_no_surfaces(rig):
    rig.state()
    rig.outcome(FlightModeCommand("SERVOS"))
    assert rig.setpoint() == SetpointCommand(0.0, 0.0)
    assert (rig.shown()["mode"], rig.shown()["fallback"]) == ("LEVEL", "demand_invalid")


def test_the_same_mode_flies_with_the_control_loop_on_the_raspberry_pi(tmp_path):
    rig = NavigationRig(tmp_path, "flight controller: raspberry\n")
    rig.state("OUTPUT")
    rig.setpoint()
    rig.outcome(FlightModeCommand("BANK"))
    rig.navigation.set()
    output = rig.frame()
    assert output.ailerons_us > 1500 and output.throttle_us == 1500
    assert not rig.setpoints


@pytest.mark.parametrize(
    ("mode", "detail"), [("BNAK", "mode_unknown"), ("BANK", "reading_stale")]
)  # fmt: skip
def test_refused_modes_change_nothing(rig, mode, detail):
    rig.clock.advance(3.1)
    rig.attitude()
    assert refusal(rig.outcome(FlightModeCommand(mode))) == detail
    assert (rig.board.asked, rig.shown()["selected"]) == ([], None)


@pytest.mark.parametrize("mode", ["ACRO", "acro", "OUTPUT", "SETPOINT", "RTH", ""])
def test_the_ground_selects_no_mode_that_is_the_pilots(tmp_path, mode):
    rig = Rig(tmp_path)
    rig.state()
    assert refusal(rig.outcome(FlightModeCommand(mode))) == "mode_unknown"
    assert rig.manager.telemetry_content["flight_control"]["selected"] == "FBW"


def test_the_pilot_ends_a_mode_by_the_switch_and_gets_no_surprise_later(rig):
    rig.state()
    rig.outcome(FlightModeCommand("BANK"))
    assert rig.setpoint()
    rig.state("FBW", auto=False)
    rig.state("SETPOINT")
    assert rig.setpoint() is None
    assert rig.shown()["selected"] is None


def test_a_mode_flies_again_when_a_silent_board_is_back_with_the_switch_at_auto(rig):
    rig.state()
    rig.outcome(FlightModeCommand("BANK"))
    assert rig.setpoint()
    rig.bus.execute_command(FlightStateCommand(None, False, False, False), BOARD)
    assert rig.setpoint() is None
    assert (rig.shown()["mode"], rig.shown()["selected"]) == (None, "BANK")
    rig.state("FBW")
    assert rig.setpoint().roll_deg == 20.0
    rig.bus.execute_command(FlightStateCommand(None, False, False, False), BOARD)
    rig.state("FBW", auto=False)
    rig.state("SETPOINT")
    assert rig.setpoint() is None, "the pilot has moved the switch"


@pytest.mark.parametrize("mode", ["LOITER", "RETURN"])
def test_without_fixes_a_circle_by_dead_reckoning_and_later_a_glide_then_the_mode_again(rig, mode):
    rig.state()
    rig.outcome(FlightModeCommand(mode))
    assert rig.setpoint().throttle_us > 1000
    shown = {}
    for after_s in (2.0, 3.0, 118.0, 121.0):
        rig.clock.advance(after_s - max(shown, default=0.0))
        for _ in range(3):
            rig.frame()
        shown[after_s] = (rig.shown()["mode"], rig.setpoints[-1].throttle_us > 1000)
    assert shown == {
        2.0: (mode, True), 3.0: ("CIRCLE", True), 118.0: ("CIRCLE", True),
        121.0: ("CIRCLE", False),
    }  # fmt: skip
    assert rig.setpoint().throttle_us > 1000
    assert rig.shown()["mode"] == mode


class Turn(FlightMode):
    NAME = "TURN"
    FALLBACK = "LEVEL"
    motor = True
    bank_limit_deg = None

    def step(self, situation, dt_s):
        return PathDemand(Bank(-40.0), motor=self.motor, bank_limit_deg=self.bank_limit_deg)


@pytest.mark.parametrize(
    ("motor", "stopped", "height_m", "roll_deg"),
    [
        (True, True, 2.0, -8.0),
        (False, False, 2.0, -8.0),
        (True, True, 8.0, -28.0),
        (True, True, 30.0, -40.0),
        (True, False, 2.0, -40.0),
        (True, True, -10.0, -8.0),
        # Over a valley.
        (True, True, -12.0, -40.0),
    ],
)
def test_without_thrust_the_bank_is_low_near_the_ground(
    tmp_path, motor, stopped, height_m, roll_deg
):
    """The height above home counts less its standard deviation of 3 m."""
    rig = NavigationRig(tmp_path, modes=(Turn,))
    rig.up.get_module(Turn).motor = motor
    state = replace(NAVIGATION, altitude_sd_m=3.0, motor_stopped=stopped)
    assert turned(rig, state, height_m) == pytest.approx(roll_deg)


def turned(rig, state, height_m):
    """Return the bank that TURN reaches, at a height above home."""
    rig.navigation.state = state
    rig.state()
    rig.setpoint()
    rig.outcome(FlightModeCommand("TURN"))
    rig.navigation.state = replace(state, altitude_m=250.0 + height_m)
    return [rig.setpoint() for _ in range(60)][-1].roll_deg


def test_an_airframe_without_motor_has_no_thrust(tmp_path):
    rig = NavigationRig(tmp_path, modes=(Turn,), navigation="performance:\n  motor: false\n")
    assert turned(rig, replace(NAVIGATION, altitude_sd_m=3.0), 2.0) == pytest.approx(-8.0)


def test_a_mode_with_a_limit_of_its_own_knows_the_ground(tmp_path):
    rig = NavigationRig(tmp_path, modes=(Turn,))
    rig.up.get_module(Turn).bank_limit_deg = 25.0
    state = replace(NAVIGATION, altitude_sd_m=3.0, motor_stopped=True)
    assert turned(rig, state, 2.0) == pytest.approx(-25.0)


def test_a_board_mode_ends_a_mode_of_the_pi(rig):
    rig.state()
    rig.outcome(FlightModeCommand("BANK"))
    rig.outcome(FlightModeCommand("FBW"))
    assert rig.setpoint() is None


def test_the_configured_mode_acts_when_the_switch_comes_to_auto(tmp_path):
    rig = NavigationRig(tmp_path, navigation="auto_mode: LEVEL\n")
    rig.state("FBW", in_flight=False)
    assert rig.board.asked == ["AUTO"]
    rig.state()
    assert rig.setpoint() == SetpointCommand(0.0, 0.0)


def test_an_auto_mode_that_is_not_loaded_is_a_veto(tmp_path):
    rig = NavigationRig(tmp_path, navigation="auto_mode: LOTIER\n")
    assert list(rig.up.vetoes.own) == ["navigation.yml"]


class Stage(FlightMode):
    """Is followed by a mode, and has a goal and a way to keep failsafes off, as the test says."""

    NAME = "STAGE"
    REQUESTS = frozenset({"target"})
    goal = None

    def step(self, situation, dt_s):
        return PathDemand(Bank(0.0))


class TestSuccessor:
    """A mode that has done its work names the next one."""

    @pytest.fixture
    def rig(self, tmp_path):
        rig = NavigationRig(tmp_path, modes=(Stage,))
        rig.state()
        rig.setpoint()
        rig.outcome(FlightModeCommand("STAGE"))
        rig.setpoint()
        rig.stage = rig.up.get_module(Stage)
        return rig

    def test_it_is_selected_and_is_no_choice_of_the_pilot(self, rig):
        choices = rig.manager.choices
        rig.stage.successor = "LOITER"
        rig.setpoint()
        assert rig.shown()["selected"] == "LOITER"
        assert rig.setpoint()
        assert rig.shown()["mode"] == "LOITER"
        assert rig.manager.choices == choices

    @pytest.mark.parametrize("name", ["GUIDED", "NOWHERE"])
    def test_one_that_refuses_or_does_not_exist_changes_nothing(self, rig, name):
        rig.stage.successor = name
        assert rig.setpoint() and rig.setpoint()
        assert rig.shown()["mode"] == "STAGE"

    def test_a_fallback_does_not_select_it(self, rig):
        rig.stage.step = None
        rig.up.get_module(Glide).successor = "LOITER"
        rig.setpoint()
        assert rig.shown()["selected"] == "STAGE"

    def test_the_goal_of_a_mode_is_shown_and_resumed_instead_of_its_circles(self, rig, tmp_path):
        rig.stage.goal = Target(Point(30.0, 40.0), 222.0)
        rig.stage.step = lambda *_: PathDemand(Circle(Point(0.0, 0.0), 50.0), 300.0)
        rig.setpoint()
        assert rig.manager.telemetry_content["navigation"]["target"]["altitude"] == 222.0
        rig.manager.home.memory.wait()
        again = NavigationRig(tmp_path, gains=None, modes=(Stage,))
        again.state()
        again.setpoint()
        again.setpoint()
        target = again.manager.situation.target
        assert target.altitude_m == 222.0
        assert target.point == pytest.approx((30.0, 40.0), abs=0.01)


class TestRestart:
    """Home, target and mode survive the program."""

    def test_in_flight_everything_is_resumed_and_no_fallback_acts_before_the_first_fix(
        self, rig, tmp_path
    ):
        rig.state()
        rig.outcome(NavigationTargetCommand(48.01, 17.0, altitude_m=300.0))
        rig.frame()
        rig.outcome(FlightModeCommand("GUIDED"))
        rig.setpoint()
        rig.manager.home.memory.wait()
        again = NavigationRig(tmp_path, gains=None)
        again.state()
        again.frame()
        assert again.setpoints == []
        assert again.setpoint()
        assert again.shown()["mode"] == "GUIDED"
        shown = again.manager.telemetry_content
        assert shown["navigation"]["target"]["latitude"] == pytest.approx(48.01)
        home = shown["home"]["latitude"], shown["home"]["longitude"]
        assert FRAME.point(*home) == pytest.approx((100.0, 50.0), abs=0.01)

    def test_if_the_readings_stay_away_the_fallback_acts(self, rig, tmp_path):
        rig.state()
        rig.outcome(FlightModeCommand("BANK"))
        rig.manager.home.memory.wait()
        again = NavigationRig(tmp_path, gains=None)
        again.state()
        again.clock.advance(3.0)
        again.frame()
        assert again.shown()["mode"] == "LEVEL"

    def test_on_the_ground_nothing_is_resumed(self, rig, tmp_path):
        rig.state()
        rig.outcome(FlightModeCommand("BANK"))
        rig.manager.home.memory.wait()
        again = NavigationRig(tmp_path, gains=None)
        again.state(None, in_flight=None)
        again.state(in_flight=False)
        assert again.shown()["selected"] is None
        again.manager.home.memory.wait()
        later = NavigationRig(tmp_path, gains=None)
        later.state()
        assert later.manager.home.place is None, "the home of an earlier flight"
