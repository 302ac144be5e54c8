"""Verdicts of whole flights, without flying: answers, control runs, crashes."""

import pytest

from tests.simulator.scenario.minimal import HEAD, log_of
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.flight_record import FlightRecord, Question
from up_simulator.scenario.report import report_lines
from up_simulator.scenario.result import (
    NO_CRASH,
    Result,
    control_scenario,
    control_verdicts,
    failed_parts,
    verdicts_of,
)

ROLL = "expect: [{name: Level, signal: truth.roll_deg, between: [-5, 5]}]\n"
CONTROL = "control: {about: nobody helps, mode: ACRO, fails: [Level]}\n"
PLACE = {"truth.north_m": lambda t: 10 * t, "truth.east_m": lambda t: -t}


def record_of(text, roll, count=201, **facts):
    scenario = parse_scenario(HEAD + text)
    log = log_of({"truth.roll_deg": roll, **PLACE}, count)
    return FlightRecord(scenario, log, flown_s=(count - 1) * 0.02, took_s=1.0, **facts)


def test_a_crash_is_told_with_time_and_place_and_does_not_hold():
    record = record_of(ROLL, lambda t: 0.0, 101, crash="it hit the ground", crash_s=2.0)
    result = Result(record, verdicts_of(record))
    assert {verdict.name for verdict in result.verdicts if not verdict.is_held} == {
        "Level",
        NO_CRASH,
    }
    told = "\n".join(report_lines("a", result))
    assert "ended at 2.00 s: it hit the ground, 20 m north and 2 m west of the start" in told
    assert "a: NOT held (0 of 2 expectations)" in told


def test_a_crash_may_be_allowed():
    record = record_of("may_crash: true\n" + ROLL, lambda t: 0.0, 101, crash="x", crash_s=2.0)
    assert Result(record, verdicts_of(record)).is_held


@pytest.mark.parametrize("broken", [{"is_interrupted": True}, {"failure": "the daemon has ended"}])
def test_a_flight_that_was_cut_short_shows_nothing_about_its_whole(broken):
    for text in (ROLL, "may_crash: true\n" + ROLL):
        record = record_of(text, lambda t: 0.0, 3, **broken)
        assert not any(verdict.is_held for verdict in verdicts_of(record))
    early = ROLL.replace("name: Level", "name: Level, to_s: 1")
    record = record_of(early, lambda t: 0.0, 101, **broken)
    assert [verdict.is_held for verdict in verdicts_of(record)] == [True, False]
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    control = record_of(ROLL, lambda t: 0.0, 51, **broken)
    assert not control_verdicts(scenario, control)[0].is_held


def test_the_report_of_an_interrupted_flight_says_so_first():
    record = record_of(ROLL, lambda t: 0.0, 3, is_interrupted=True)
    lines = list(report_lines("a", Result(record, verdicts_of(record))))
    assert lines[1] == "  INTERRUPTED: the flight was interrupted at 0.04 s of 4 s"
    assert lines[-1] == "a: NOT held (0 of 2 expectations)"


def test_a_control_run_must_fail_with_a_figure():
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    fails = control_verdicts(scenario, record_of(ROLL, lambda t: 9.0))
    holds = control_verdicts(scenario, record_of(ROLL, lambda t: 0.0))
    unknown = control_verdicts(scenario, record_of(ROLL, lambda t: float("nan")))
    assert [each[0].is_held for each in (fails, holds, unknown)] == [True, False, False]
    assert fails[0].name.startswith("Without it (") and " this must fail: 'Level'" in fails[0].name
    assert "not" not in fails[0].name and fails[0].limit.startswith("asked for: ")
    assert "shows nothing" in holds[0].why
    assert "cannot be measured" in unknown[0].why


def test_a_crash_of_the_control_run_is_a_visible_failure():
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    record = record_of(ROLL, lambda t: 0.0, 51, crash="it hit the ground", crash_s=1.0)
    assert control_verdicts(scenario, record)[0].is_held


def test_the_control_run_takes_away_what_it_says():
    text = "sticks: [{at_s: 0, mode: FBW}, {at_s: 1, mode: AUTO, ailerons: 1}]\n"
    control = control_scenario(parse_scenario(HEAD + text + ROLL + CONTROL))
    assert [point.mode for point in control.sticks] == ["ACRO", None, None]
    assert control.sticks[2].ailerons == 1 and control.control is None
    direct = control_scenario(
        parse_scenario(HEAD + text + ROLL + CONTROL.replace("mode: ACRO", "board: direct"))
    )
    assert direct.board == "direct"
    assert [point.mode for point in direct.sticks] == ["FBW", "AUTO"]


@pytest.mark.parametrize(
    ("wanted", "answer", "is_held"),
    [
        ("ack", "", True),
        ("ack", "switch is not at AUTO", False),
        ("ack", None, False),
        ("nack", "switch is not at AUTO", True),
        ("nack", "", False),
        ("none", None, True),
        ("none", "", False),
    ],
)
def test_an_answer_is_what_was_wanted_or_not(wanted, answer, is_held):
    text = (
        "raspilot: {runs: in process}\nground: {}\n"
        f"events: [{{at_s: 1, command: {{name: up.arm, answer: {wanted}}}}}]\n"
    )
    record = record_of(text + ROLL, lambda t: 0.0)
    event = record.scenario.events[0]
    answered_s = None if answer is None else 1.5
    record.questions.append(Question(event, event.command, "1", 1.0, answer, answered_s))
    verdict = verdicts_of(record)[1]
    assert verdict.is_held is is_held
    if answer:
        assert answer in verdict.why or is_held


def test_a_late_answer_and_a_command_that_was_never_sent_do_not_hold():
    text = (
        "raspilot: {runs: in process}\nground: {}\n"
        "events: [{at_s: 1, command: {name: up.arm, answer: ack, within_s: 0.2}}]\n"
    )
    record = record_of(text + ROLL, lambda t: 0.0)
    assert "never sent" in [verdict.figure for verdict in verdicts_of(record)]
    event = record.scenario.events[0]
    record.questions.append(Question(event, event.command, "1", 1.0, "", 1.3))
    assert [verdict.is_held for verdict in verdicts_of(record)] == [True, False, True]


def test_what_a_terminal_would_carry_out_is_escaped():
    text = ROLL.replace("Level", '"a\\e[31m\\a"')
    record = record_of(text, lambda t: 0.0)
    told = "".join(report_lines("a", Result(record, verdicts_of(record))))
    assert told.isprintable() and "a\\x1b[31m" in told


def test_a_failure_is_told_with_the_daemons_last_lines():
    record = record_of(ROLL, lambda t: 0.0, failure="the daemon has ended", failure_log=["last"])
    result = Result(record, verdicts_of(record))
    told = "\n".join(report_lines("a", result))
    assert "could not go on" in told and "    | last" in told
    assert not result.is_held


def test_a_picture_is_told_where_what_failed():
    record = record_of(ROLL, lambda t: 9.0)
    (part,) = failed_parts(Result(record, verdicts_of(record)))
    assert (part.signal, part.begin_s, part.end_s) == ("truth.roll_deg", 0.0, 4.0)
    assert "Level: 9 to 9 deg" in part.text
