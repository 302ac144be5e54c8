"""Home before arming: when it is required, and where it may be."""

from dataclasses import replace

import pytest
from twisted.logger import capturedLogs

from raspilot.flight_modes.return_home import Return
from raspilot.modules.failsafes import Failsafes
from raspilot.modules.home_checks import HomeChecks
from raspilot.modules.plans import Plans
from tests.raspilot.flight_controller_rig import PHONE
from tests.raspilot.mission.test_borders import circle, polygon
from tests.raspilot.navigation_rig import STANDING, NavigationRig
from up.commands.location_command import LocationCommand
from up.commands.system_commands import LinkStateCommand

INACCURATE = replace(STANDING, position_sd_m=20.0)
WARN = "".join(
    f"{name}: {{action: warn}}\n"
    for name in ("fence", "receiver_lost", "uplink_lost", "flight_battery_critical")
)


class HomeRig(NavigationRig):
    def __init__(self, folder, fence=(), navigation="", failsafe=""):
        super().__init__(
            folder, modes=(Return,), modules=(Failsafes, HomeChecks, Plans),
            navigation="home_accuracy_m: 5\n" + navigation, failsafe=failsafe,
        )  # fmt: skip
        self.checks = self.up.get_module(HomeChecks)
        self.use(fence)
        self.checks.on_start()
        self.navigation.set(INACCURATE)
        self.state("FBW", armed=False, auto=False, in_flight=False)

    def use(self, fence):
        self.up.get_module(Plans).fences.use(tuple(fence), "0123456789abcdef")

    def vetoes(self, navigation=None):
        if navigation is not None:
            self.navigation.set(navigation)
        self.frame()
        self.clock.advance(0.5)
        return list(self.up.vetoes.own)


def connect_phone(rig, is_connected=True):
    rig.bus.execute_command(LinkStateCommand("android", is_connected), PHONE)


def locate(rig):
    rig.bus.execute_command(LocationCommand(48.0, 17.0, 200.0), PHONE)


@pytest.mark.parametrize("expect_position", [connect_phone, locate])
def test_where_a_position_can_be_expected_arming_waits_for_home(tmp_path, expect_position):
    rig = HomeRig(tmp_path)
    assert rig.vetoes() == [], "a pilot without a phone flies by hand"
    expect_position(rig)
    assert rig.vetoes() == ["home"]
    assert rig.vetoes(STANDING) == []


def test_a_phone_that_is_taken_away_leaves_the_pilot_to_fly_by_hand(tmp_path):
    rig = HomeRig(tmp_path)
    connect_phone(rig)
    assert rig.vetoes() == ["home"]
    connect_phone(rig, is_connected=False)
    assert rig.vetoes() == []


@pytest.mark.parametrize(("navigation", "failsafe"), [("arm_without_home: true\n", ""), ("", WARN)])
def test_home_is_not_required_if_that_is_configured_or_no_failsafe_returns(
    tmp_path, navigation, failsafe
):
    rig = HomeRig(tmp_path, navigation=navigation, failsafe=failsafe)
    connect_phone(rig)
    assert rig.vetoes() == []


AROUND = [circle(100, 50, 120)]
AWAY = [circle(300, 50, 120)]
NEAR = [circle(180, 50, 120)]


@pytest.mark.parametrize(
    ("fence", "failsafe", "vetoes"),
    [
        (AROUND, "", []),
        (AWAY, "", ["fence"]),
        (AWAY, WARN, ["fence"]),
        (NEAR, "", ["fence"]),
        (NEAR, WARN, []),
    ],
)
def test_home_must_be_inside_the_fence_with_the_circle_of_return(tmp_path, fence, failsafe, vetoes):
    rig = HomeRig(tmp_path, fence, failsafe=failsafe)
    assert rig.vetoes() == [], "home is not known"
    assert rig.vetoes(STANDING) == vetoes


def test_the_veto_ends_with_another_fence_and_nothing_changes_in_flight(tmp_path):
    rig = HomeRig(tmp_path, AWAY)
    assert rig.vetoes(STANDING) == ["fence"]
    rig.use(AROUND)
    assert rig.vetoes() == []
    rig.state()
    rig.use(AWAY)
    assert rig.vetoes() == []


@pytest.mark.parametrize(
    ("fence", "is_warned"),
    [
        (AROUND, False),
        ([*AROUND, circle(300, 50, 30, is_inside=False)], True),
        ([polygon((-200, -200), (-200, 300), (900, 300), (300, 50), (900, -200))], False),
        ([polygon((-200, -200), (-200, 900), (900, 900), (200, 300), (200, -200))], True),
    ],
)
def test_a_fence_that_a_straight_way_home_can_cross_is_a_warning(tmp_path, fence, is_warned):
    rig = HomeRig(tmp_path, fence)
    with capturedLogs() as events:
        assert rig.vetoes(STANDING) == []
        rig.vetoes()
    codes = [each.get("code") for each in events]
    assert codes.count("return_crosses_fence") == is_warned
