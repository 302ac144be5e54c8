"""TAKEOFF: what starts the motor, and what stops it."""

from dataclasses import replace

import pytest

from raspilot.flight_modes.takeoff import Takeoff
from tests.raspilot.flight_modes.mode_rig import ModeRig, bound
from tests.raspilot.navigation.point_mass import PointMass
from up.commands.rx_command import ALL_VALID, RXCommand
from up.flight_modes.demand import AttitudeDemand
from up.flight_modes.flight_mode import Target
from up.flight_modes.navigation_state import Point

STILL = {"velocity_m_s": Point(0.0, 0.0), "is_in_flight": False, "altitude_m": 250.0}
THROWN = {**STILL, "velocity_m_s": Point(8.0, 0.0)}


def throttle(us, ailerons=1500):
    return RXCommand(ailerons, 1500, us, 1500, 2000, 2000, ALL_VALID)


class Hand(ModeRig):
    """Steps of one second; ``seen`` changes the estimate."""

    now_s = 0.0

    def __init__(self, folder, **files):
        super().__init__(bound(Takeoff, folder, **files), PointMass(), rx=throttle(1000))
        self.seen = dict(STILL)

    @property
    def situation(self):
        situation = super().situation
        navigation = situation.navigation and replace(situation.navigation, **self.seen)
        return replace(situation, time_s=self.now_s, navigation=navigation)

    def step(self, seen=None, **given):
        self.seen |= seen or {}
        self.given |= given
        self.now_s += 1.0
        return self.mode.step(self.situation, 0.02)

    def thrown(self):
        """Return after the throw: the motor runs."""
        self.enter()
        assert self.step().throttle == 0.0
        assert self.step(rx=throttle(1600)).throttle == 0.0
        assert self.step(THROWN).throttle == 0.7
        return self


@pytest.fixture
def hand(tmp_path):
    return Hand(tmp_path)


def test_a_throw_starts_the_motor_and_it_climbs_with_level_wings_until_loiter(hand):
    hand.thrown()
    for climbed_m in (1.0, 5.0, 20.0, 26.0):
        assert hand.step({"altitude_m": 250.0 + climbed_m}) == AttitudeDemand(0.0, 7.0, 0.7)
        assert hand.mode.successor == ""
    hand.step({"altitude_m": 277.5})
    assert hand.mode.successor == "LOITER"


@pytest.mark.parametrize(
    ("target_m", "climbs_at_m", "turns_at_m"), [(262, 258, 260), (250, 256.5, 257.5)]
)
def test_the_target_gives_another_altitude_but_none_near_the_ground(
    hand, target_m, climbs_at_m, turns_at_m
):
    hand.given["target"] = Target(Point(0.0, 0.0), target_m)
    hand.thrown().step({"altitude_m": climbs_at_m})
    assert hand.mode.successor == ""
    hand.step({"altitude_m": turns_at_m})
    assert hand.mode.successor == "LOITER"


@pytest.mark.parametrize(
    ("seen", "given"),
    [
        ({"velocity_m_s": Point(0.0, 4.9)}, {}),
        ({"fix_age_s": 3.5}, {}),
        ({}, {"rx": throttle(1200)}),
        ({}, {"rx": None}),
    ],
    ids=["a running thrower", "an old fix", "a stick without consent", "an unknown stick"],
)
def test_in_the_hand_the_motor_stays_off(hand, seen, given):
    hand.enter()
    hand.step()
    hand.step(rx=throttle(1600))
    demand = hand.step(THROWN | seen, **given)
    assert (demand.roll_deg, demand.throttle) == (0.0, 0.0)
    assert demand.pitch_deg < 1.0, "it glides until a fix shows the throw"


def test_without_a_position_or_carried_on_its_side_the_motor_stays_off(hand):
    hand.enter()
    hand.step()
    hand.plane.roll = 50.0
    assert hand.step(THROWN, rx=throttle(1600)).throttle == 0.0
    hand.plane.roll, hand.has_navigation = 0.0, False
    assert hand.step().throttle == 0.0
    hand.has_navigation = True
    assert hand.step().throttle == 0.7


def test_a_stick_that_was_never_closed_is_no_consent(hand):
    hand.given["rx"] = None
    hand.enter()
    assert hand.step(THROWN, rx=throttle(1600)).throttle == 0.0
    assert hand.step(rx=throttle(1000)).throttle == 0.0
    assert hand.step(rx=throttle(1600)).throttle == 0.7


def test_entered_with_a_raised_stick_the_sticks_fly(hand):
    """The motor runs by the stick already, for example after a restart of the program."""
    hand.given["rx"] = throttle(1600, ailerons=1750)
    hand.enter()
    assert hand.step(THROWN) == AttitudeDemand(25.0, 0.0)
    assert hand.step(rx=throttle(1000)).throttle is None


def test_a_closed_stick_gives_the_aircraft_to_the_pilot(hand):
    hand.thrown()
    assert hand.step(rx=None).throttle == 0.7, "one late frame is no decision"
    assert hand.step(rx=throttle(1100)) == AttitudeDemand(0.0, 0.0)
    assert hand.step(rx=throttle(1600)).throttle is None


def test_without_a_climb_the_pilot_gets_the_aircraft(hand):
    hand.thrown()
    hand.step({"altitude_m": 253.0})
    hand.now_s += 6.0
    assert hand.step().throttle == 0.7
    assert hand.step().throttle is None


def test_failsafes_wait_only_while_it_is_in_the_hand(hand):
    hand.enter()
    hand.step()
    assert hand.mode.is_uninterrupted
    hand.thrown()
    assert not hand.mode.is_uninterrupted


@pytest.mark.parametrize(
    ("seen", "given", "code"),
    [
        ({"fix_age_s": 3.5}, {}, "navigation"),
        ({"is_in_flight": True}, {}, "in_flight"),
        ({"velocity_m_s": Point(0.0, 3.1)}, {}, "in_flight"),
        ({}, {"rx": throttle(1150)}, "throttle_not_low"),
        ({}, {"rx": None}, "throttle_not_low"),
    ],
)
def test_it_refuses(hand, seen, given, code):
    assert hand.mode.refusal(hand.situation) is None
    hand.seen |= seen
    hand.given |= given
    assert hand.mode.refusal(hand.situation).code == code


def test_a_glider_has_no_motor_for_it(tmp_path):
    hand = Hand(tmp_path, navigation="performance: {motor: false}")
    assert hand.mode.refusal(hand.situation).code == "no_motor"
