"""The selected mode acts, or a fallback in the same step; nothing flies on an old demand."""

import math
import time
from typing import ClassVar

import pytest

from up.commands.orientation_command import OrientationCommand
from up.commands.refusal import CommandRefusedError
from up.flight_modes.demand import AttitudeDemand, Bank, Circle, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, ModeRefusal
from up.flight_modes.navigation_state import Point
from up.flight_modes.selector import DemandError, FlightModeSelector

SITUATION = FlightSituation(1.0, OrientationCommand(0.0, 0.0, 0.0))


class Last(FlightMode):
    NAME = "LAST"
    FALLBACK = ""
    NEEDS: ClassVar = {}

    def step(self, situation, dt_s):
        return AttitudeDemand(1.0, 0.0)


class Safe(FlightMode):
    NAME = "SAFE"
    FALLBACK = "LAST"

    def step(self, situation, dt_s):
        return AttitudeDemand(2.0, 0.0)


class Best(FlightMode):
    NAME = "BEST"
    FALLBACK = "SAFE"
    NEEDS: ClassVar = {"orientation": 0.1, "navigation": 3.0}
    entered = 0

    def refusal(self, situation):
        return self.reason

    reason = None

    def enter(self, situation):
        self.entered += 1

    def step(self, situation, dt_s):
        return AttitudeDemand(3.0, 0.0)


@pytest.fixture
def rig():
    return Rig()


class Rig:
    def __init__(self, best=Best):
        self.stale = set()
        self.best = best()
        modes = (self.best, Safe(), Last())
        self.selector = FlightModeSelector(modes, lambda reading, _: reading not in self.stale)
        self.selector.select("BEST")

    def step(self):
        made = self.selector.step(SITUATION, 0.02, lambda demand, *_: demand)
        return made and made.roll_deg


def test_the_selected_mode_acts_and_is_entered_once(rig):
    assert [rig.step(), rig.step()] == [3.0, 3.0]
    assert (rig.selector.active, rig.selector.reason, rig.best.entered) == ("BEST", None, 1)
    rig.selector.select("BEST")
    rig.step()
    assert rig.best.entered == 2


def test_a_stale_reading_is_bridged_by_the_fallback_and_not_entered_again(rig):
    rig.step()
    rig.stale = {"navigation"}
    assert rig.step() == 2.0
    assert (rig.selector.active, rig.selector.reason) == ("SAFE", "navigation")
    rig.stale = {"navigation", "orientation"}
    assert rig.step() == 1.0
    rig.stale = set()
    assert rig.step() == 3.0
    assert (rig.selector.reason, rig.best.entered) == (None, 1)


def _raising(self, situation, dt_s):
    raise RuntimeError("broken")


def _exiting(self, situation, dt_s):
    raise SystemExit(1)


def _blocking(self, situation, dt_s):
    time.sleep(0.05)
    return AttitudeDemand(3.0, 0.0)


def _computing(self, situation, dt_s):
    until = time.thread_time() + 0.05
    while time.thread_time() < until:
        pass
    return AttitudeDemand(3.0, 0.0)


@pytest.mark.parametrize(
    ("step", "code"),
    [
        (_raising, "mode_failed"),
        (_exiting, "mode_failed"),
        (_computing, "mode_overrun"),
        (lambda *_: None, "demand_invalid"),
        (lambda *_: AttitudeDemand(math.nan, 0.0), "demand_invalid"),
        (lambda *_: AttitudeDemand("5", 0.0), "demand_invalid"),
        (lambda *_: PathDemand(Circle(Point(0.0, math.inf), 50.0)), "demand_invalid"),
        (lambda *_: PathDemand(Bank(math.nan)), "demand_invalid"),
        (lambda *_: PathDemand(Bank(0.0), bank_limit_deg=math.nan), "demand_invalid"),
    ],
)
def test_a_mode_that_fails_is_replaced_in_the_same_step_until_it_is_selected_again(step, code):
    rig = Rig(type("Bad", (Best,), {"step": step}))
    assert rig.step() == 2.0
    assert (rig.selector.active, rig.selector.reason) == ("SAFE", code)
    type(rig.best).step = Best.step
    assert rig.step() == 2.0
    rig.selector.select("BEST")
    assert rig.step() == 3.0


def test_a_mode_may_declare_a_longer_budget():
    assert Rig(type("Slow", (Best,), {"step": _computing, "TIME_BUDGET_S": 30.0})).step() == 3.0


def test_a_mode_that_waits_is_replaced_at_the_second_time():
    """Once it may be a thread that holds Python's lock while another program runs."""
    rig = Rig(type("Bad", (Best,), {"step": _blocking}))
    assert [rig.step(), rig.step()] == [3.0, 2.0]
    assert (rig.selector.active, rig.selector.reason) == ("SAFE", "mode_overrun")


def test_a_demand_that_cannot_be_carried_out_now_is_tried_again(rig):
    def without_rates(demand, *_):
        if demand.roll_deg > 1.0:
            raise DemandError("no rates", "rates")
        return demand

    assert rig.selector.step(SITUATION, 0.02, without_rates).roll_deg == 1.0
    assert rig.selector.reason == "rates"
    assert rig.step() == 3.0


def test_without_a_mode_that_can_act_nothing_is_made(rig):
    rig.selector.modes["LAST"].NEEDS = {"orientation": 0.1}
    rig.stale = {"orientation"}
    assert rig.step() is None
    assert (rig.selector.active, rig.selector.reason) == (None, "orientation")


def test_what_is_offered_and_why_the_rest_is_not(rig):
    rig.stale = {"navigation"}
    offers = rig.selector.offers(SITUATION)
    assert offers == {"BEST": "navigation", "SAFE": None, "LAST": None}
    rig.stale, rig.best.reason = set(), "no home"
    assert rig.selector.offers(SITUATION)["BEST"] == "mode_refused"
    rig.best.reason = ""
    assert rig.selector.offers(SITUATION)["BEST"] is None
    rig.best.reason = ModeRefusal("no_home", "no home")
    assert rig.selector.offers(SITUATION)["BEST"] == "no_home"


@pytest.mark.parametrize(
    ("name", "stale", "reason", "detail"),
    [
        ("BEST", {"navigation"}, None, "reading_stale"),
        ("BEST", set(), "no home", "mode_refused"),
        ("BEST", set(), ModeRefusal("no_home", "no home"), "no_home"),
        ("BSET", set(), None, "mode_unknown"),
        ("", set(), None, "mode_unknown"),
    ],
)
def test_refusals(rig, name, stale, reason, detail):
    rig.stale, rig.best.reason = stale, reason
    with pytest.raises(CommandRefusedError) as caught:
        rig.selector.check(name, SITUATION)
    assert caught.value.detail == detail


@pytest.mark.parametrize("name", ["", "AUTO", "RATE", "loiter", "A" * 17, "SAFE"])
def test_a_name_that_cannot_be_used_is_a_problem_and_the_others_fly(name):
    bad = type("Bad", (Best,), {"NAME": name})
    rig = Rig(bad)
    if name == "SAFE":
        assert list(rig.selector.problems) == [Safe().path]
    else:
        assert list(rig.selector.problems) == [rig.best.path]
        assert set(rig.selector.modes) == {"SAFE", "LAST"}


def test_a_fallback_that_is_not_loaded_is_a_problem():
    lost = type("Lost", (Best,), {"FALLBACK": "NOWHERE"})
    assert list(Rig(lost).selector.problems) == [lost().path]
