"""The failsafe engine: delays, priority, and that only the pilot ends an action."""

import pytest

from raspilot.failsafe.config import Fence, PhoneBattery, UplinkLost
from raspilot.failsafe.engine import FailsafeEngine

TRIGGERS = {
    "fence": Fence(action="RETURN", delay_s=0),
    "uplink_lost": UplinkLost(action="RETURN", delay_s=5),
    "phone_battery": PhoneBattery(action="warn", delay_s=0),
}


@pytest.fixture
def engine():
    return FailsafeEngine(TRIGGERS)


def test_a_failure_counts_after_its_delay_without_a_break(engine):
    seen = []
    for now_s, lost in enumerate([1, 1, 1, 0, 1, 1, 1, 1, 1, 1]):
        engine.update(now_s, {"uplink_lost": bool(lost)})
        seen.append(engine.wanted(None, ()))
    assert seen == [None] * 9 + ["uplink_lost"]


def test_the_first_trigger_decides_and_a_later_one_never_replaces_it(engine):
    engine.update(0, {"uplink_lost": True})
    engine.update(5, {"uplink_lost": True, "fence": True})
    assert engine.active == ["fence", "uplink_lost"]
    assert engine.wanted(None, ()) == "fence"
    assert engine.wanted("uplink_lost", ()) == "fence"
    assert engine.wanted("fence", ()) is None
    engine.update(6, {"uplink_lost": True})
    assert engine.wanted("fence", ()) is None, "it acts until the pilot ends it"


def test_what_only_warns_or_does_not_apply_selects_nothing(engine):
    engine.update(0, {"phone_battery": True, "fence": True})
    assert engine.wanted(None, ("fence",)) is None
    assert engine.active == ["fence", "phone_battery"]


def test_the_pilots_decision_holds_until_the_failure_was_over(engine):
    engine.update(0, {"fence": True})
    engine.override()
    engine.update(1, {"fence": True, "uplink_lost": True})
    assert engine.wanted(None, ()) is None
    engine.update(6, {"fence": True, "uplink_lost": True})
    assert engine.wanted(None, ()) == "uplink_lost", "the pilot did not know of this one"
    engine.update(7, {})
    engine.update(8, {"fence": True})
    assert engine.wanted(None, ()) == "fence"
