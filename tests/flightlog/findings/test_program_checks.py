"""Faults of the program: load, gains, modes, refused Commands, the recording, logged errors."""

import pytest

from tests.flightlog.flights import (
    BOARD,
    GROUND,
    PanicCommand,
    PIDTuningsCommand,
    PIDTuningsValuesCommand,
    SystemStateCommand,
    TelemetryCommand,
)
from tests.flightlog.flights import FlightStateCommand as State
from up.commands.answer_commands import CommandAnsweredCommand
from up_flightlog.findings.all_checks import findings

ARMED = State("FBW", True, False, False)


def answered(name, code="", reason="", untold=0):
    outcome = "nack" if code else "ack"
    link = "mission_control"
    return CommandAnsweredCommand(link, name, "1", outcome, code, reason, untold=untold)


def gains(p: float) -> dict:
    axes = {axis: {"p": p, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator")}
    return {"ratePIDs": axes, "stabPIDs": axes}


def test_panic(maker, only):
    for time_s, command in (
        (0, PanicCommand(False, 50)),
        (1, PanicCommand(True, 150, 97.5)),
        (1.5, PanicCommand(True, 150, 99.0)),
        (2, PanicCommand(False, 50, 60.0)),
    ):
        maker.put(time_s, command)
    finding = only()
    assert (finding.code, finding.length_s, finding.fields) == ("panic", 1.0, {"load": 97.5})


def test_gains_changed_in_flight(maker, tmp_path):
    maker.every(0, 10, 0.5, lambda time_s: State("FBW", False, 2 <= time_s < 6, False))
    maker.put(0.5, PIDTuningsValuesCommand(gains(1.0)), BOARD)
    maker.put(1, PIDTuningsCommand(None, gains(2.0)), GROUND)
    maker.put(2.5, PIDTuningsCommand(True, None), GROUND)
    changed = gains(2.0)
    changed["ratePIDs"] = {**changed["ratePIDs"], "elevator": {"p": 2.5, "i": 0, "d": 0.0}}
    maker.put(3, PIDTuningsCommand(None, changed), GROUND)
    maker.put(4, PIDTuningsCommand(None, changed), GROUND)
    maker.put(7, PIDTuningsCommand(None, gains(9.0)), GROUND)
    found = findings(maker.log(tmp_path))
    assert [(each.time_s, each.code) for each in found] == [
        (3.0, "gains_changed"),
        (4.0, "gains_changed"),
    ]
    origin = "mission_control (pilot)"
    assert found[0].fields == {"origin": origin, "changes": "rate pitch P 2 to 2.5"}


def test_gains_in_single_precision_are_equal_and_refused_ones_are_not_reported(maker, tmp_path):
    maker.every(0, 12, 0.5, ARMED)
    maker.put(1, PIDTuningsCommand(None, gains(0.1)), GROUND)
    maker.put(2, PIDTuningsValuesCommand(gains(0.10000000149011612)), BOARD)
    maker.put(3, PIDTuningsCommand(None, gains(0.1)), GROUND)
    for time_s, gain, code in ((7, 2.0, "refused"), (11, 1.5, "")):
        maker.put(time_s, PIDTuningsCommand(None, gains(gain)), GROUND)
        maker.put(time_s + 0.1, answered(PIDTuningsCommand.NAME, code))
    found = [each for each in findings(maker.log(tmp_path)) if each.code == "gains_changed"]
    assert [each.time_s for each in found] == [1.0, 3.0, 11.0]
    assert found[0].fields["changes"] == ""
    assert "0.1 to 1.5" in found[2].fields["changes"]


@pytest.mark.parametrize(
    ("known_s", "in_flight", "level", "count"),
    [(0.0, 37, "warning", 37), (1.0, 3, "info", 0), (1.0, 9, "warning", 6)],
)
def test_event_loop_blocked(maker, only, known_s, in_flight, level, count):
    """A block before the flight mode is known is during the start-up, and only an info."""
    fields = {"call": "SlowModule", "ms": 20.0}
    maker.every(0, 0.1, 0.1, SystemStateCommand(1.0, 1.0, (), False, "auto"))
    maker.line(0.1, 4, "ReactorMonitor", "any text", code="event_loop_blocked", **fields)
    maker.every(known_s, 2, 0.5, State("FBW", False, False, False))
    maker.put(1.2, TelemetryCommand({"counters": {"reactor": {"SlowModule": 3}}}, 1))
    counters = {"reactor": {"SlowModule": in_flight}}
    maker.put(2, TelemetryCommand({"counters": counters}, 2))
    finding = only()
    assert (finding.level, finding.code) == (level, "event_loop_blocked")
    assert finding.fields == {"call": "SlowModule", "count": count}


def test_reports_of_the_recorder(maker, tmp_path):
    maker.line(1, 4, "BlackBox", "a", code="recording_stopped", problem="/x: disk full")
    maker.line(1.5, 2, "BlackBox", "b", code="recording_resumed", path="/y.mcap", count=250)
    maker.line(1.6, 3, "BlackBox", "c", code="messages_dropped", count=12)
    maker.line(1.7, 3, "BlackBox", "d", code="recording_removed", path="/y.mcap")
    found = findings(maker.log(tmp_path))
    assert [(each.level, each.code) for each in found] == [
        ("alarm", "recording_stopped"),
        ("warning", "recording_resumed"),
        ("warning", "messages_dropped"),
        ("warning", "recording_removed"),
    ]
    for finding, value in zip(found, ("/x: disk full", "250", "12", "/y.mcap"), strict=True):
        assert value in finding.text


def test_a_flight_without_codes_has_no_such_finding(maker, found):
    """An older version recorded the sentences only."""
    blocked = "SlowModule holds the reactor for more than 20 ms, and with it everything"
    maker.line(0, 3, "ReactorMonitor", blocked)
    maker.line(1, 3, "BlackBox", "12 messages were not recorded: the disk is too slow")
    maker.line(2, 2, "CommandExecutor", "ArduinoArming refused up.arm: the throttle is not low")
    assert found() == []


def test_errors_of_the_log(maker, tmp_path):
    maker.line(1, 2, "CommandExecutor", "x", code="command_refused", name="up.arm")
    for time_s in (2, 3, 4):
        maker.line(time_s, 4, "Up", "module\nx\x1b[31m failed")
    maker.line(3, 3, "Up", "only a warning")
    maker.line(4, 5, "", "fatal", code="broken", part=7)
    first, second = findings(maker.log(tmp_path))
    assert (first.time_s, first.code) == (1.0, "logged_error")
    assert first.text == "Up: module\\nx\\x1b[31m failed (3 times)"
    assert (second.subject, second.fields) == ("broken", {"code": "broken", "part": 7})


def test_refused_commands_once_per_kind(maker, tmp_path):
    for number in range(10):
        maker.put(1 + number / 10, answered("up.disarm", "refused", "the throttle is not low"))
    maker.put(1.5, answered("up.disarm"))
    maker.put(1.6, answered("up.arm", "stale", "up.arm: too old"))
    maker.put(1.9, answered("up.arm", untold=480))
    found = findings(maker.log(tmp_path))
    assert [(round(each.time_s, 1), each.level, each.code) for each in found] == [
        (0.0, "info", "command_refused"),
        (0.6, "info", "command_refused"),
        (0.9, "info", "answers_dropped"),
    ]
    link = "mission_control"
    fields = {"name": "up.disarm", "link": link, "reason": "refused", "count": 10}
    assert found[0].fields == fields
    assert found[2].fields == {"count": 480}


def test_provisional_mode(maker, found):
    for time_s, mode in ((0, "flight controller"), (1, "black box (provisional)"), (2, "auto")):
        maker.put(time_s, SystemStateCommand(1.0, 1.0, (), False, mode))
    assert found() == [(1.0, "warning", "provisional_mode", 1.0)]


def test_a_gap_in_all_topics(maker, found):
    maker.every(0, 2, 0.2, ARMED)
    maker.every(6, 8, 0.2, ARMED)
    assert found() == [(1.8, "alarm", "log_gap", 4.2)]


def test_a_truncated_log(maker, tmp_path):
    maker.quiet_flight()
    (finding,) = findings(maker.log(tmp_path, is_finished=False))
    assert (finding.level, finding.code, finding.subject) == ("warning", "log_damaged", "cut_off")
