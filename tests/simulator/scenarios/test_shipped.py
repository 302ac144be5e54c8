"""Every shipped scenario states its purpose; those of the Arduino alone hold."""

import dataclasses

import pytest

from tests.simulator.scenarios.mutate import ROOT, mutations
from tests.simulator.scenarios.shipped import ALONE, REAL, SCENARIOS, WITH_DAEMON, fly
from up_simulator.scenario.measures import limit_text
from up_simulator.verbs.catalogue import shipped_paths

# Expectations that check only who controls the aircraft need no separate number.
MIN_EXPECTATIONS = 2
PAIRS = (("controller-on", "OUTPUT"), ("loiter-on", "OUTPUT"), ("return-on", None))
ATTITUDE = ("truth.roll_deg", "truth.pitch_deg", "error.roll_deg", "error.pitch_deg")
CONTROLLERS = ("controller-on-arduino", "controller-on-raspberry")


def test_there_are_scenarios_of_each_kind():
    assert len(SCENARIOS) == len(shipped_paths())
    assert len(ALONE) >= 15 and len(WITH_DAEMON) >= 12 and len(REAL) >= 4


@pytest.mark.parametrize("name", SCENARIOS)
def test_it_says_what_it_shows_and_by_which_figures(name):
    scenario = SCENARIOS[name]
    assert scenario.title and scenario.about and scenario.tags
    assert len(scenario.expect) >= MIN_EXPECTATIONS
    assert any(any(each.isdigit() for each in limit_text(limit)) for limit in scenario.expect)
    assert scenario.board in ("auto", "direct", "host", "betaflight") and not scenario.may_crash
    # The firmware on its chip flies what shows the board; the host build is quicker.
    assert scenario.board == "host" or "navigation" not in scenario.tags
    assert scenario.board != "host" or {"navigation", "link"} & set(scenario.tags)


def test_each_guards_a_rule_and_was_seen_to_fail_without_it():
    rules = mutations()
    assert {name for name, each in SCENARIOS.items() if not each.guards} == set()
    assert {name for name, each in SCENARIOS.items() if each.control is None} <= set(rules)
    for name, parts in rules.items():
        assert name in SCENARIOS
        for path, find, _ in parts:
            assert (ROOT / path).read_text(encoding="utf-8").count(find) == 1, (name, path)


def test_titles_differ():
    titles = [scenario.title for scenario in SCENARIOS.values()]
    assert len(set(titles)) == len(titles)


@pytest.mark.parametrize("name", SCENARIOS)
def test_real_programs_and_only_they_are_tagged_real(name):
    assert ("real" in SCENARIOS[name].tags) == (name in REAL)


def attitudes(scenario):
    """Return the names of the attitude's expectations."""
    return {each.name for each in scenario.expect if each.signal in ATTITUDE}


def is_rough(scenario):
    """Return whether the air tries what holds the attitude; light turbulence hardly does."""
    weather = scenario.weather
    return weather.turbulence in ("moderate", "severe") or bool(weather.gusts)


IN_ROUGH_AIR = [name for name, each in SCENARIOS.items() if is_rough(each) and attitudes(each)]


def test_there_is_rough_air():
    assert {"level-flight-in-gusts", "wing-in-gusts", *CONTROLLERS} <= set(IN_ROUGH_AIR)


@pytest.mark.parametrize("name", IN_ROUGH_AIR)
def test_an_attitude_that_is_held_in_rough_air_is_not_in_the_control_run(name):
    control = SCENARIOS[name].control
    assert control is not None and attitudes(SCENARIOS[name]) & set(control.fails)


@pytest.mark.parametrize("name", ["save", "fbw-roll-step", "fbw-pitch-step", "wing-steps"])
def test_what_could_succeed_by_itself_has_a_control_run(name):
    control = SCENARIOS[name].control
    assert control is not None and control.fails


@pytest.mark.parametrize(("pair", "mode"), PAIRS)
def test_the_controller_moves_by_configuration_only(pair, mode):
    on_arduino, on_raspberry = (SCENARIOS[f"{pair}-{each}"] for each in ("arduino", "raspberry"))
    config = {**on_arduino.raspilot.config, "config.yml": {"flight controller": "raspberry"}}
    where = on_arduino.expect[0]
    moved = dataclasses.replace(
        on_arduino,
        title=on_raspberry.title,
        about=on_raspberry.about,
        guards=on_raspberry.guards,
        raspilot=dataclasses.replace(on_arduino.raspilot, config=config),
        expect=(dataclasses.replace(where, is_=mode or where.is_), *on_arduino.expect[1:]),
    )
    assert on_arduino.raspilot.config["config.yml"] == {"flight controller": "arduino"}
    assert where.is_ != mode
    assert moved == on_raspberry


@pytest.mark.parametrize("name", ALONE)
def test_what_the_arduino_flies_alone_holds(name):
    assert fly(name) == []
