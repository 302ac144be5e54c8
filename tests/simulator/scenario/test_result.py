"""Verdicts of whole flights, without flying: answers, control runs, crashes."""

import pytest

from tests.simulator.scenario.minimal import HEAD, log_of
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.flight_record import FlightRecord, PendingCommand
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
CONTROL = "control: {about: no help, mode: ACRO, fails: [Level]}\n"
PLACE = {"truth.north_m": lambda t: 10 * t, "truth.east_m": lambda t: -t}


def record_of(text, roll, count=201, **facts):
    scenario = parse_scenario(HEAD + text)
    log = log_of({"truth.roll_deg": roll, **PLACE}, count)
    return FlightRecord(scenario, log, flown_s=(count - 1) * 0.02, took_s=1.0, **facts)


def codes_of(verdicts):
    return {verdict.name: verdict.code for verdict in verdicts}


def test_a_crash_has_time_and_place():
    record = record_of(ROLL, lambda t: 0.0, 101, crash="it hit the ground", crash_s=2.0)
    result = Result(record, verdicts_of(record))
    assert codes_of(result.verdicts) == {"Level": "flight_ended", NO_CRASH: "crashed"}
    report = "\n".join(report_lines("a", result))
    assert "2.00 s: " in report and "20 m north" in report and "2 m west" in report
    allowed = record_of("may_crash: true\n" + ROLL, lambda t: 0.0, 101, crash="x", crash_s=2.0)
    assert Result(allowed, verdicts_of(allowed)).is_held


@pytest.mark.parametrize("end", [{"is_interrupted": True}, {"failure": "the daemon has ended"}])
def test_a_flight_that_was_cut_short_proves_nothing_about_its_rest(end):
    for text in (ROLL, "may_crash: true\n" + ROLL):
        record = record_of(text, lambda t: 0.0, 3, **end)
        assert not any(verdict.is_held for verdict in verdicts_of(record))
    early = ROLL.replace("name: Level", "name: Level, to_s: 1")
    record = record_of(early, lambda t: 0.0, 101, **end)
    assert codes_of(verdicts_of(record)) == {"Level": "", NO_CRASH: "cut_short"}
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    control = record_of(ROLL, lambda t: 0.0, 51, **end)
    assert control_verdicts(scenario, control)[0].code == "cut_short"


def test_the_report_of_an_interrupted_flight_begins_with_the_interruption():
    record = record_of(ROLL, lambda t: 0.0, 3, is_interrupted=True)
    lines = list(report_lines("a", Result(record, verdicts_of(record))))
    assert "INTERRUPTED" in lines[1] and "0 of 2" in lines[-1]


def test_a_control_run_must_fail_with_a_figure():
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    codes = [
        control_verdicts(scenario, record_of(ROLL, roll))[0].code
        for roll in (lambda t: 9.0, lambda t: 0.0, lambda t: float("nan"))
    ]
    assert codes == ["", "control_held", "control_not_measured"]


def test_a_crash_of_the_control_run_is_a_visible_failure():
    scenario = parse_scenario(HEAD + ROLL + CONTROL)
    record = record_of(ROLL, lambda t: 0.0, 51, crash="it hit the ground", crash_s=1.0)
    assert control_verdicts(scenario, record)[0].is_held


def test_the_control_run_disables_a_mode_or_the_board():
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
    ("expected", "answer", "code"),
    [
        ("ack", "", ""),
        ("ack", "switch is not at AUTO", "wrong_answer"),
        ("ack", None, "no_answer"),
        ("nack", "switch is not at AUTO", ""),
        ("nack", "", "wrong_answer"),
        ("none", None, ""),
        ("none", "", "wrong_answer"),
        ("ack, within_s: 0.2", "", "late_answer"),
    ],
)
def test_an_answer_is_compared_with_the_expected_one(expected, answer, code):
    text = (
        "raspilot: {runs: in process}\nground: {}\n"
        f"events: [{{at_s: 1, command: {{name: up.arm, answer: {expected}}}}}]\n"
    )
    record = record_of(text + ROLL, lambda t: 0.0)
    event = record.scenario.events[0]
    assert "not_sent" in codes_of(verdicts_of(record)).values()
    answered_s = None if answer is None else 1.5
    record.pending_commands.append(
        PendingCommand(event, event.command, "1", 1.0, answer, answered_s)
    )
    verdict = verdicts_of(record)[1]
    assert (verdict.is_held, verdict.code) == (not code, code)
    assert not answer or answer in verdict.why or verdict.is_held


def test_terminal_controls_are_escaped():
    text = ROLL.replace("Level", '"a\\e[31m\\a"')
    record = record_of(text, lambda t: 0.0)
    report = "".join(report_lines("a", Result(record, verdicts_of(record))))
    assert report.isprintable() and "a\\x1b[31m" in report


def test_a_failure_is_reported_with_the_newest_log_lines():
    record = record_of(ROLL, lambda t: 0.0, failure="ended", failure_log=["last"])
    result = Result(record, verdicts_of(record))
    lines = list(report_lines("a", result))
    assert "    | last" in lines and any("ended" in line for line in lines)
    assert not result.is_held


def test_failures_are_located_for_the_picture():
    record = record_of(ROLL, lambda t: 9.0)
    (part,) = failed_parts(Result(record, verdicts_of(record)))
    assert (part.signal, part.begin_s, part.end_s) == ("truth.roll_deg", 0.0, 4.0)
