"""docs/scenarios.md: its tables are those of the code, its examples fly."""

import re

import pytest

from tests.docs.scenarios_page import BEGIN, END, GROUPS, PAGE, tables
from tests.support.firmware import build_firmware
from up_simulator.cli import main
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.expectation import KINDS
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.result import verdicts_of
from up_simulator.scenario.signals import SIGNALS

TEXT = PAGE.read_text(encoding="utf-8")
SCENARIOS = re.findall(r"<!-- scenario -->\n```yaml\n(.*?)```", TEXT, re.DOTALL)
RUNS = re.findall(r"<!-- run: up-sim -->\n```\n(.*?)```", TEXT, re.DOTALL)


def test_the_tables_are_those_of_the_code():
    told = TEXT.partition(BEGIN)[2].partition(END)[0]
    assert told.strip() == tables().strip(), "python -m tests.docs.scenarios_page writes them"


def test_every_signal_has_a_group():
    assert {signal.source for signal in SIGNALS.values()} == set(GROUPS)


def test_every_kind_of_expectation_is_explained():
    table = TEXT.partition("## Expectations")[2].partition("## Control run")[0]
    for kind in KINDS:
        assert f"`{kind.rstrip('_')}:" in table, kind


@pytest.mark.parametrize("text", SCENARIOS, ids=lambda text: text.splitlines()[0][7:])
def test_the_scenarios_of_the_page_fly_and_hold(text):
    build_firmware()
    record = build_flight(parse_scenario(text)).fly()
    assert [verdict for verdict in verdicts_of(record) if not verdict.is_held] == []


@pytest.mark.parametrize("lines", RUNS)
def test_the_commands_of_the_page_run(lines, tmp_path, monkeypatch, capsys):
    build_firmware()
    monkeypatch.chdir(tmp_path)
    for line in lines.splitlines():
        program, *arguments = line.split()
        assert program == "up-sim"
        assert main(arguments) == 0, (line, capsys.readouterr())


def test_there_is_something_to_run():
    assert len(SCENARIOS) == 3 and len(RUNS) == 2
