"""The failsafes with the real flight mode manager, RETURN, a board, a ground and a pilot."""

from dataclasses import replace

import pytest
from twisted.logger import capturedLogs

from raspilot.flight_modes.loiter import Loiter
from raspilot.flight_modes.return_home import Return
from raspilot.modules.failsafes import Failsafes
from raspilot.modules.plans import Plans
from tests.docs.test_how_to import examples
from tests.raspilot.flight_controller_rig import BOARD
from tests.raspilot.mission.test_borders import circle
from tests.raspilot.navigation_rig import FRAME, NAVIGATION, STANDING, NavigationRig
from up.base_module import BaseModule
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.failures import FailureSource
from up.flight_modes.navigation_state import Point

CONFIG = """
fence: {radius_m: 500}
uplink_lost: {delay_s: 10}
phone_battery: {action: LOITER, delay_s: 5}
"""
FAR = replace(NAVIGATION, position=Point(580.0, 50.0))
INACCURATE = replace(NAVIGATION, position_sd_m=20.0)


class Battery(BaseModule, FailureSource):
    """The phone's battery, which the test empties."""

    is_low = False

    @property
    def failures(self):
        return {"phone_battery": self.is_low}


class FailsafeRig(NavigationRig):
    def __init__(self, folder, failsafe=CONFIG, modules=(), radius=""):
        super().__init__(
            folder, modes=(Return,), modules=(Failsafes, Battery, *modules), failsafe=failsafe,
            **{"return": radius},
        )  # fmt: skip
        self.failsafes = self.up.get_module(Failsafes)
        self.battery = self.up.get_module(Battery)
        self.failsafes.on_start()

    def take_off(self):
        self.navigation.set(STANDING)
        self.state("FBW", armed=False, in_flight=False)
        self.frame()
        self.navigation.set(NAVIGATION)
        self.state()
        self.fly(1.0)

    def fly(self, seconds):
        for _ in range(round(seconds / 0.1)):
            self.setpoint()
            self.clock.advance(0.08)

    def seen(self):
        content = self.failsafes.telemetry_content["failsafe"]
        return content["active"], content["cause"], self.shown()["selected"]


@pytest.fixture
def rig(tmp_path):
    made = FailsafeRig(tmp_path)
    made.take_off()
    made.outcome(FlightModeCommand("LOITER"))
    made.fly(0.5)
    return made


def test_the_uplink_is_lost_and_the_aircraft_returns_until_the_ground_decides_again(rig):
    rig.ground.is_there = False
    rig.fly(9.5)
    assert rig.seen() == ([], None, "LOITER")
    rig.fly(1.0)
    assert rig.seen() == (["uplink_lost"], "uplink_lost", "RETURN")
    rig.ground.is_there = True
    rig.fly(1.0)
    assert rig.seen() == ([], "uplink_lost", "RETURN"), "it continues when the link is back"
    rig.outcome(FlightModeCommand("LOITER"))
    rig.fly(1.0)
    assert rig.seen() == ([], None, "LOITER")


def test_the_switch_ends_it_and_the_same_failure_does_not_act_again(rig):
    rig.ground.is_there = False
    rig.fly(11.0)
    rig.state("FBW", auto=False)
    rig.fly(1.0)
    rig.state()
    rig.fly(20.0)
    assert rig.seen() == (["uplink_lost"], None, None)


def test_telemetry_has_the_limits_that_are_set(tmp_path):
    rig = FailsafeRig(tmp_path, "fence: {radius_m: 500, floor_m: -20}\n")
    limits = rig.failsafes.telemetry_content["fence"]
    assert limits == {"margin": None, "radius": 500.0, "floor": -20.0}


def test_in_flight_neither_a_target_nor_home_may_be_outside_the_fence(tmp_path):
    rig = FailsafeRig(tmp_path, modules=(Plans,))
    rig.take_off()
    rig.up.get_module(Plans).fences.use((circle(100, 50, 400),), "0123456789abcdef")
    rig.fly(1.0)

    def detail_of(command, north_m):
        latitude_deg, longitude_deg = FRAME.degrees(Point(100.0 + north_m, 50.0))
        [outcome] = rig.outcome(command(latitude_deg, longitude_deg))
        return outcome and outcome.value.detail

    assert detail_of(NavigationTargetCommand, 390) is None
    assert detail_of(NavigationTargetCommand, 410) == "outside_fence"
    assert detail_of(HomeCommand, 410) == "outside_fence"
    assert detail_of(HomeCommand, 390) is None
    rig.up.get_module(Plans).fences.use((), "")
    rig.fly(1.0)
    assert detail_of(NavigationTargetCommand, 880) is None
    assert detail_of(NavigationTargetCommand, 900) == "outside_fence", "the radius of failsafe.yml"
    rig.state("FBW", armed=False, in_flight=False)
    assert detail_of(HomeCommand, 900) is None, "on the ground it is a reason not to arm"


def test_with_the_switch_elsewhere_nothing_acts(rig):
    rig.state("FBW", auto=False)
    rig.ground.is_there = False
    rig.navigation.set(FAR)
    rig.fly(30.0)
    assert rig.seen() == (["fence", "uplink_lost"], None, None)
    assert rig.board.asked == [], "nothing is requested of the board"


def test_the_sticks_fly_on_without_an_uplink(tmp_path):
    rig = FailsafeRig(tmp_path)
    rig.take_off()
    rig.ground.is_there = False
    rig.fly(30.0)
    assert rig.seen() == (["uplink_lost"], None, None)


def test_a_flight_that_never_had_a_ground_needs_none(tmp_path):
    rig = FailsafeRig(tmp_path)
    rig.ground.is_there = False
    rig.take_off()
    rig.outcome(FlightModeCommand("LOITER"))
    rig.fly(30.0)
    assert rig.seen() == ([], None, "LOITER")


def test_before_the_fence_is_crossed_it_returns_and_a_less_important_failure_changes_nothing(rig):
    rig.navigation.set(FAR)
    rig.fly(0.5)
    assert rig.seen() == (["fence"], "fence", "RETURN")
    rig.battery.is_low = True
    rig.fly(6.0)
    assert rig.seen() == (["fence", "phone_battery"], "fence", "RETURN")


def test_a_low_battery_acts_after_its_delay_and_the_fence_takes_over(rig):
    rig.outcome(FlightModeCommand("BANK"))
    rig.battery.is_low = True
    rig.fly(4.5)
    assert rig.seen()[2] == "BANK"
    rig.fly(1.0)
    assert rig.seen() == (["phone_battery"], "phone_battery", "LOITER")
    rig.navigation.set(FAR)
    rig.fly(0.5)
    assert rig.seen() == (["fence", "phone_battery"], "fence", "RETURN")


@pytest.mark.parametrize("follows", [True, False])
def test_without_the_receiver_it_returns_if_the_board_lets_it(tmp_path, follows):
    rig = FailsafeRig(tmp_path)
    rig.take_off()
    lost = FlightStateCommand("FBW", True, False, True, True)
    with capturedLogs() as events:
        rig.bus.execute_command(lost, BOARD)
        rig.fly(1.5)
        assert rig.setpoint().is_failsafe
        if follows:
            rig.bus.execute_command(replace(lost, flight_mode="RETURN"), BOARD)
        rig.fly(4.0)
    assert [each.get("log_code", each.get("code")) for each in events].count("failsafe_acts") == 1
    if follows:
        assert rig.seen() == (["receiver_lost"], "receiver_lost", "RETURN")
    else:
        assert rig.seen() == (["receiver_lost"], None, None)


def test_a_mode_that_needs_no_sticks_flies_on_without_the_receiver(rig):
    rig.bus.execute_command(FlightStateCommand("RETURN", True, True, True, True), BOARD)
    rig.fly(5.0)
    assert rig.seen() == (["receiver_lost"], None, "LOITER")


def test_without_home_the_fallback_of_return_flies(rig):
    rig.navigation.set(INACCURATE)
    rig.manager.home.place = None
    rig.ground.is_there = False
    rig.fly(11.0)
    assert rig.seen() == (["uplink_lost"], "uplink_lost", "CIRCLE")


def test_on_the_ground_nothing_is_a_failure(rig):
    rig.ground.is_there = False
    rig.fly(11.0)
    rig.state("FBW", armed=False, in_flight=False)
    rig.fly(1.0)
    assert rig.seen()[:2] == ([], None)


@pytest.mark.parametrize(
    ("failsafe", "count"),
    [
        ("", 0),
        ("uplink_lost: {action: RETRUN}\n", 1),
        ("fence: {ceiling_m: 50}\n", 1),
        ("fence: {ceiling_m: 50, action: warn}\nuplink_lost: {action: LOITER}\n"
         "receiver_lost: {action: warn}\nflight_battery_critical: {action: warn}\n", 0),
        ("fence: {floor_m: 70, ceiling_m: 100, radius_m: 100}\n", 1),
    ],
)  # fmt: skip
def test_contradictions_are_vetoes_against_arming(tmp_path, failsafe, count):
    rig = FailsafeRig(tmp_path, failsafe=failsafe)
    assert len(rig.up.vetoes.own) == count


class Faulty(BaseModule, FailureSource):
    @property
    def failures(self):
        raise ValueError("no sensor")


def test_the_failure_of_the_how_to_page_returns_and_a_faulty_module_costs_nothing_else(tmp_path):
    names = {}
    page = examples("failsafe.md")
    exec(page["plane/modules/flight_time.py"], names)
    more = (names["FlightTime"], Faulty)
    rig = FailsafeRig(tmp_path, modules=more, failsafe=page["plane/config/failsafe.yml"])
    with capturedLogs():
        rig.take_off()
        rig.outcome(FlightModeCommand("LOITER"))
        rig.fly(1.0)
        rig.clock.advance(names["LIMIT_S"])
        rig.fly(1.0)
    assert rig.seen() == (["flight_time"], "flight_time", "RETURN")
    assert not rig.up.vetoes.own


def test_a_failure_that_no_module_reports_is_a_veto(tmp_path):
    rig = FailsafeRig(tmp_path, failsafe="others: {flight_tmie: {action: RETURN}}\n")
    assert list(rig.up.vetoes.own) == ["failsafe.yml.flight_tmie"]


def test_no_progress_is_noticed_after_its_delay(rig):
    rig.navigation.set(replace(NAVIGATION, position=Point(100.0, 450.0)))
    rig.outcome(FlightModeCommand("RETURN"))
    rig.fly(31.0)
    assert rig.seen() == (["no_progress"], None, "RETURN")
    rig.navigation.set(replace(NAVIGATION, position=Point(100.0, 430.0)))
    rig.fly(1.0)
    assert rig.seen() == ([], None, "RETURN")
    rig.navigation.set(replace(NAVIGATION, position=Point(100.0, 80.0)))
    rig.fly(35.0)
    assert rig.seen() == ([], None, "RETURN"), "it circles at home"


def test_a_mode_that_is_blown_away_from_its_circle_makes_no_progress(rig):
    rig.fly(35.0)
    assert rig.seen() == ([], None, "LOITER")
    rig.navigation.set(replace(NAVIGATION, position=Point(-300.0, 50.0)))
    rig.fly(31.0)
    assert rig.seen() == (["no_progress"], None, "LOITER")


def test_at_home_the_wide_circle_that_a_wind_requires_is_no_lack_of_progress(tmp_path):
    rig = FailsafeRig(tmp_path, failsafe="no_progress: {action: LOITER}\n", radius="radius_m: 15\n")
    rig.take_off()
    wind = replace(NAVIGATION, wind_m_s=Point(12.0, 0.0), position=Point(100.0, 125.0))
    rig.navigation.set(wind)
    rig.outcome(FlightModeCommand("RETURN"))
    rig.fly(35.0)
    assert rig.seen() == ([], None, "RETURN"), "it circles at home"
    rig.navigation.set(replace(wind, position=Point(100.0, 350.0)))
    rig.fly(35.0)
    assert rig.seen() == ([], "no_progress", "LOITER")


def test_no_failsafe_interrupts_a_mode_that_forbids_it(rig, monkeypatch):
    """A landing, or an aircraft in the hand: RETURN would start the motor."""
    monkeypatch.setattr(type(rig.up.get_module(Loiter)), "is_uninterrupted", True)
    rig.ground.is_there = False
    rig.fly(11.0)
    assert rig.seen() == (["uplink_lost"], None, "LOITER")
    monkeypatch.undo()
    rig.fly(1.0)
    assert rig.seen() == (["uplink_lost"], "uplink_lost", "RETURN")
