"""Every shipped scenario says what it shows; those of the Arduino alone hold."""

import dataclasses

import pytest

from tests.simulator.scenarios.shipped import ALONE, REAL, SCENARIOS, WITH_DAEMON, fly
from up_simulator.scenario.measures import limit_text
from up_simulator.verbs.shelf import shipped_paths

# Expectations that look for no more than who flies need no number of their own.
LEAST_EXPECTATIONS = 2
CONTROLLERS = ("controller-on-arduino", "controller-on-raspberry")


def test_there_are_scenarios_of_each_kind():
    assert len(SCENARIOS) == len(shipped_paths())
    assert len(ALONE) >= 15 and len(WITH_DAEMON) >= 12 and len(REAL) >= 4


@pytest.mark.parametrize("name", SCENARIOS)
def test_it_says_what_it_shows_and_by_which_figures(name):
    scenario = SCENARIOS[name]
    assert scenario.title and scenario.about and scenario.tags
    assert len(scenario.expect) >= LEAST_EXPECTATIONS
    assert any(any(each.isdigit() for each in limit_text(limit)) for limit in scenario.expect)
    assert scenario.board in ("auto", "direct") and not scenario.may_crash


def test_titles_differ():
    titles = [scenario.title for scenario in SCENARIOS.values()]
    assert len(set(titles)) == len(titles)


@pytest.mark.parametrize("name", SCENARIOS)
def test_real_programs_and_only_they_are_tagged_real(name):
    assert ("real" in SCENARIOS[name].tags) == (name in REAL)


@pytest.mark.parametrize(
    "name",
    ["level-flight-in-gusts", "wing-in-gusts", "save", "fbw-roll-step", "arduino-alone"],
)
def test_what_could_succeed_by_itself_has_a_control_run(name):
    control = SCENARIOS[name].control
    assert control is not None and control.fails


def test_the_controller_moves_by_configuration_only():
    on_arduino, on_raspberry = (SCENARIOS[name] for name in CONTROLLERS)
    config = {"config.yml": {"flight controller": "raspberry"}}
    where = on_arduino.expect[0]
    assert where.is_ == "FBW"
    moved = dataclasses.replace(
        on_arduino,
        title=on_raspberry.title,
        raspilot=dataclasses.replace(on_arduino.raspilot, config=config),
        expect=(dataclasses.replace(where, is_="OUTPUT"), *on_arduino.expect[1:]),
    )
    assert on_arduino.raspilot.config == {"config.yml": {"flight controller": "arduino"}}
    assert moved == on_raspberry


@pytest.mark.parametrize("name", ALONE)
def test_what_the_arduino_flies_alone_holds(name):
    assert fly(name) == []
