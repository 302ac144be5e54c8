"""The judge of a proof and its advice, on tracks made by hand."""

from dataclasses import replace

import pytest

from up_simulator.prove.advice import advice_of, story
from up_simulator.prove.cases import Case
from up_simulator.prove.flight import Outcome
from up_simulator.prove.judge import Limits, Sample, figures_of, judge
from up_simulator.prove.page import Proof, document, page
from up_simulator.prove.setup import Setup

LIMITS = Limits(stall_m_s=6.0, fail_s=10.0, deadline_s=15.0, settled_s=25.0)
DEMANDING = replace(
    LIMITS, trigger="receiver_lost", action="RETURN", priority=("fence",), radius_m=400.0
)


def track(**changes):
    """Return 40 s of a level flight 100 m from home; a change has a function of the time."""
    plain = Sample(0.0, 100.0, 0.0, 60.0, 11.0, "RETURN", "SETPOINT")
    times = [at / 10 for at in range(400)]
    made = [{name: value(at) for name, value in changes.items()} for at in times]
    return [replace(plain, time_s=at, **each) for at, each in zip(times, made, strict=True)]


def seen(from_s=11.0):
    return lambda at: ("receiver_lost",) if at >= from_s else ()


@pytest.mark.parametrize(
    ("limits", "changes", "crash", "found"),
    [
        (LIMITS, {}, None, {}),
        (LIMITS, {}, "it has hit the ground", {"crash": 39.9}),
        (replace(LIMITS, may_land=True), {}, "it has hit the ground", {"crash": 39.9}),
        # A landing: it slides and stops.
        (
            replace(LIMITS, may_land=True),
            {"height_m": lambda at: 60.0 - 2 * min(at, 30.0), "airspeed_m_s": lambda at: 38 - at},
            None,
            {},
        ),
        # 1.05 times the stall is 6.3 m/s; a gust of 0.3 s is none.
        (LIMITS, {"airspeed_m_s": lambda at: 6.2 if 12 <= at < 12.3 else 11.0}, None, {}),
        (LIMITS, {"airspeed_m_s": lambda at: 6.2 if at >= 12 else 11.0}, None, {"stall": 12.3}),
        (replace(LIMITS, radius_m=150.0), {"east_m": lambda at: 5 * at}, None, {"outside": 22.4}),
        (
            replace(LIMITS, radius_m=150.0, is_blown=True),
            {"east_m": lambda at: 5 * at},
            None,
            {},
        ),
        (replace(LIMITS, ceiling_m=59.0), {}, None, {"above_ceiling": 0.0}),
        (replace(LIMITS, floor_m=61.0), {}, None, {}),
        (
            replace(LIMITS, floor_m=30.0),
            {"height_m": lambda at: 60 - 2 * at},
            None,
            {"below_floor": 15.1},
        ),
        (
            replace(LIMITS, floor_m=30.0, may_land=True),
            {"height_m": lambda at: 60 - 2 * at},
            None,
            {},
        ),
        # Farther by 100 m than when it should have turned home: 250 m at 25 s.
        (LIMITS, {"north_m": lambda at: 10 * at}, None, {"fly_away": 35.1}),
        (LIMITS, {"north_m": lambda at: max(250 - 10 * at, 140 - 10 * at)}, None, {}),
        (
            replace(LIMITS, arrived_m=380.0),
            {"north_m": lambda at: 10 * at},
            None,
            {"fly_away": 38.1},
        ),
        (replace(LIMITS, circle_m=60.0), {"north_m": lambda at: 10 * at}, None, {}),
        (DEMANDING, {"active": seen()}, None, {}),
        (DEMANDING, {}, None, {"no_reaction": 15.0}),
        (DEMANDING, {"active": seen(15.5)}, None, {"no_reaction": 15.0}),
        (DEMANDING, {"active": seen(), "mode": lambda _: "LOITER"}, None, {"no_reaction": 15.0}),
        (DEMANDING, {"active": seen(), "board_mode": lambda _: "FBW"}, None, {"no_reaction": 15.0}),
        (
            DEMANDING,
            {"active": seen(), "mode": lambda _: "LOITER", "cause": lambda _: "fence"},
            None,
            {},
        ),
        (
            replace(DEMANDING, action="warn"),
            {"active": seen(), "board_mode": lambda _: "FBW"},
            None,
            {},
        ),
    ],
)
def test_what_is_wrong_has_a_code_and_a_time(limits, changes, crash, found):
    assert dict(judge(track(**changes), limits, crash)) == pytest.approx(found)


def test_causes_come_before_their_effects():
    fallen = track(height_m=lambda at: 60 - at, airspeed_m_s=lambda at: 11 - at / 10)
    found = judge(fallen, replace(DEMANDING, floor_m=30.0), "it has hit the ground")
    assert [code for code, _ in found] == ["no_reaction", "below_floor", "crash"]


def test_the_figures_count_from_the_failure():
    drifting = track(height_m=lambda at: 90 - at, north_m=lambda at: -3 * at, active=seen(12.0))
    figures = figures_of(drifting, DEMANDING)
    assert figures.height_lost_m == pytest.approx(29.9)
    assert figures.drift_m_min == pytest.approx(180.0)
    assert figures.greatest_m == pytest.approx(119.7)
    assert figures.reaction_s == pytest.approx(2.0)


def setup(**changes):
    values = {
        "failsafe.yml": {
            "receiver_lost": {"action": "RETURN", "delay_s": 1.0},
            "uplink_lost": {"action": "warn", "delay_s": 5.0},
            "flight_battery_critical": {"action": "RETURN", "delay_s": 10.0},
            "fence": {"action": "RETURN", "delay_s": 0.0, "radius_m": 300.0, "ceiling_m": 55.0,
                      "floor_m": 30.0},
        },
        "return.yml": {"height_m": 25.0, "radius_m": 50.0},
        "flight_battery.yml": {"critical_v": 9.9},
        "airframe.yml": {"receiver_lost": {"pi_may_fly": None, "return_with_motor": None}},
        "navigation.yml": {"airspeed": {
            "stall_m_s": 5.0, "minimum_m_s": 6.0, "cruise_m_s": 11.0, "maximum_m_s": 16.0}},
    }  # fmt: skip
    for file, keys in changes.items():
        values[f"{file}.yml"] |= keys
    return Setup("config", "glider", "arduino", {}, values, 6.5, 3, 0.08)


def outcome(row, found, wind_m_s=6.0, **changes):
    flown = track(**changes)
    case = Case(row, "far", "arduino", wind_m_s, 180.0, "light", 1)
    figures = figures_of(flown, LIMITS)
    return Outcome(case, ((found, 20.0),), figures, flown, "it fell", "", "", 1.0)


PERMITTED = {"receiver_lost": {"pi_may_fly": True, "return_with_motor": False}}


@pytest.mark.parametrize(
    ("flown", "changes", "keys", "proposed"),
    [
        (outcome("receiver_lost", "no_reaction"), {},
         ["receiver_lost.pi_may_fly", "receiver_lost.action"], [True, "warn"]),
        (outcome("receiver_lost", "crash"), {"airframe": PERMITTED},
         ["receiver_lost.pi_may_fly", "receiver_lost.return_with_motor"], [True, True]),
        (outcome("uplink_lost", "no_reaction"), {},
         ["uplink_lost.action", "uplink_lost.delay_s"], [None, None]),
        (outcome("uplink_lost", "fly_away"), {},
         ["uplink_lost.action", "uplink_lost.delay_s"], ["RETURN", None]),
        (outcome("gps_lost", "fly_away", 12.0), {},
         ["airspeed.cruise_m_s", "airspeed.maximum_m_s"], [None, None]),
        (outcome("gps_lost", "stall"), {},
         ["airspeed.stall_m_s", "airspeed.minimum_m_s"], [None, 7.8]),
        (outcome("gps_lost", "below_floor", height_m=lambda at: 26.0), {},
         ["height_m", "fence.floor_m"], [44, None]),
        (outcome("flight_battery_critical", "below_floor", height_m=lambda at: 26.0), {},
         ["critical_v", "flight_battery_critical.delay_s"], [None, None]),
        (outcome("gps_lost", "above_ceiling"), {}, ["height_m", "fence.ceiling_m"], [40, None]),
        (outcome("gps_lost", "outside", north_m=lambda at: 320.0), {},
         ["fence.radius_m", "airspeed.cruise_m_s"], [None, None]),
        (outcome("gps_lost", "crash", height_m=lambda at: 60 - at), {},
         ["height_m", "fence.floor_m"], [65, None]),
    ],
)  # fmt: skip
def test_two_settings_are_named(flown, changes, keys, proposed):
    settings = advice_of(flown, setup(**changes)).settings
    assert [each.key for each in settings] == keys
    assert [each.proposed for each in settings] == proposed


def test_the_page_shows_a_failed_flight_and_nothing_of_a_text_is_markup():
    flown = replace(outcome("gps_lost", "crash"), crash="<b>it fell</b>")
    proof = Proof(setup(), 2, [flown], left_out={"fence_floor": "not set"})
    text = page(proof)
    assert text.count("<polyline") == 1 and "<b>" not in text and "&lt;b&gt;it fell" in text
    assert "http" not in text.replace("http-equiv", "")
    (flight,) = document(proof)["flights"]
    assert (flight["codes"], flight["held"]) == (("crash",), False)
    assert "it fell" in story(flown, setup())
    assert not proof.is_whole and not proof.is_held
