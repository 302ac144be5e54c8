"""docs/flights.md names every scenario with its limits; pages name scenarios that exist."""

import re

import pytest

from tests.docs.flights_page import BEGIN, END, GROUPS, PAGE, group_of, shipped
from tests.docs.test_pages import PAGES, name_of, text_of
from up_simulator.scenario.measures import limit_text

SCENARIOS = shipped()
FAILURES = PAGE.with_name("failure-modes.md")
_NAMED = re.compile(r"`up-sim (?:fly|check) ([a-z0-9-]+)")
_SECTION = re.compile(r"^### (\S+)\n\n(.*?)(?=^##|^<!--)", re.MULTILINE | re.DOTALL)
_ROW = re.compile(r"^\| (.+) \| (.+) \| (.+) \|$", re.MULTILINE)


def sections():
    generated = text_of(PAGE).partition(BEGIN)[2]
    return dict(_SECTION.findall(generated))


def test_every_scenario_stands_there_once_under_its_heading():
    assert list(sections()) == [
        name for group in GROUPS for name, each in SCENARIOS.items() if group_of(each) == group
    ]
    assert text_of(PAGE).count(END) == 1


@pytest.mark.parametrize("name", SCENARIOS)
def test_its_expectations_and_limits_are_those_of_the_file(name):
    scenario, text = SCENARIOS[name], sections()[name]
    assert f"**{scenario.title}** ({scenario.duration_s:g} s)" in text
    assert " ".join(scenario.about.split()) in text
    assert f"Guards: {scenario.guards}." in text
    rows = [(what, limit) for what, _figure, limit in _ROW.findall(text)][1:]
    wanted = [(each.name, limit_text(each)) for each in scenario.expect]
    assert rows[: len(wanted)] == wanted


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_scenarios_that_it_names_are_shipped(page):
    assert set(_NAMED.findall(text_of(page))) <= set(SCENARIOS) | {
        "first-flight",
        "my-flight",
        "eight",
    }


def test_every_scenario_about_safety_stands_among_the_failures():
    named = set(_NAMED.findall(text_of(FAILURES)))
    assert {name for name, each in SCENARIOS.items() if "safety" in each.tags} <= named


def test_scenarios_are_found_where_pages_name_them():
    assert _NAMED.findall("`up-sim fly save`") == ["save"]
    assert _NAMED.findall("`up-sim check x-y --seed 3`") == ["x-y"]
