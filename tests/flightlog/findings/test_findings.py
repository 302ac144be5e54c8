"""Each detector finds its fault by code, level, time, length and fields."""

import pytest

from tests.flightlog.flights import (
    ALL_VALID,
    BOARD,
    GOOD,
    GROUND,
    HEARD,
    IMU,
    PHONE,
    RECEIVER,
    RESTORED,
    WATCHDOG,
    AndroidBatteryLowCommand,
    FlightMaker,
    LinkStateCommand,
    LocationCommand,
    OrientationCommand,
    PanicCommand,
    PIDTuningsCommand,
    PIDTuningsValuesCommand,
    RXCommand,
    SystemStateCommand,
    TelemetryCommand,
    status,
)
from tests.flightlog.flights import FlightStateCommand as State
from tests.flightlog.logs import LogMaker
from up.commands.answer_commands import CommandAnsweredCommand
from up_flightlog.findings import summary
from up_flightlog.findings.detectors import DETECTORS, findings
from up_flightlog.findings.flight_context import FlightContext

ARMED = State("FBW", True, False, False)


@pytest.fixture
def maker():
    return FlightMaker()


@pytest.fixture
def found(maker, tmp_path):
    """Return a function that analyses the flight: time, level, code and length of each finding."""

    def found(is_finished=True):
        return [
            (round(each.time_s, 1), each.level, each.code, round(each.length_s, 2))
            for each in findings(maker.log(tmp_path, is_finished))
        ]

    return found


@pytest.fixture
def only(maker, tmp_path):
    """Return a function that analyses the flight and returns its single finding."""

    def only():
        (finding,) = findings(maker.log(tmp_path))
        return finding

    return only


def rx(valid: int) -> RXCommand:
    return RXCommand(1500, 1500, 1000, 1500, 1000, 2000, valid)


def answered(name, code="", reason="", untold=0):
    outcome = "nack" if code else "ack"
    return CommandAnsweredCommand("mission_control", name, "1", outcome, code, reason, untold)


def gains(p: float) -> dict:
    axes = {axis: {"p": p, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator")}
    return {"ratePIDs": axes, "stabPIDs": axes}


def test_a_quiet_flight_has_no_findings(maker, found):
    maker.quiet_flight()
    maker.put(8.05, rx(ALL_VALID - 1), BOARD)
    for link in ("arduino", "mission_control", "android"):
        maker.put(19.8, LinkStateCommand(link, False))
    assert found() == []


def test_receiver_lost_in_flight(maker, found):
    maker.quiet_flight(armed=(0, 20))
    for number in range(13):
        maker.put(8.05 + number * 0.1, rx(0), BOARD)
    # The quiet flight continues in between: as if the connection came and went.
    ((_, *finding),) = found()
    assert finding == ["alarm", "receiver_lost", 1.25]


def test_receiver_lost_before_the_first_pulse_and_after_landing(maker, found):
    maker.every(0, 5, 0.1, rx(0))
    maker.every(5, 15, 0.1, rx(ALL_VALID))
    maker.every(15, 20, 0.1, rx(0))
    maker.every(0, 20, 0.2, State("FBW", False, False, False))
    assert found() == [(15.0, "info", "receiver_lost", 4.9)]


def test_lost_channels_are_named(maker, only):
    maker.every(0, 2, 0.02, rx(ALL_VALID))
    maker.every(2, 3, 0.02, rx(ALL_VALID & ~0b110000))
    maker.every(3, 5, 0.02, rx(ALL_VALID))
    finding = only()
    assert (finding.time_s, finding.level, finding.code) == (2.0, "warning", "channels_lost")
    assert finding.subject == "aux1, aux2"
    assert finding.length_s == pytest.approx(1.0)


def test_receiver_lost_by_the_status_where_no_inputs_are_logged(maker, found):
    for begin_s, end_s, flags in ((0, 4, GOOD), (4, 6, GOOD & ~RECEIVER), (6, 8, GOOD)):
        maker.every(begin_s, end_s, 0.2, status(flags=flags))
    assert found() == [(4.0, "warning", "receiver_lost", 2.0)]


def test_failsafe_and_imu(maker, found):
    for begin_s, end_s, flags in ((0, 4, GOOD), (4, 5, GOOD & ~IMU), (5, 9, GOOD)):
        maker.every(begin_s, end_s, 0.2, status(flags=flags))
    maker.every(0, 6, 0.2, ARMED)
    maker.every(6, 7, 0.2, State("FBW", True, False, True))
    maker.every(7, 9, 0.2, ARMED)
    assert found() == [(4.0, "alarm", "imu_invalid", 1.0), (6.0, "alarm", "failsafe", 1.0)]


@pytest.mark.parametrize(
    ("cause", "level", "in_flight"),
    [(WATCHDOG | RESTORED, "alarm", True), (2, "warning", False)],
)
def test_board_reset(maker, only, cause, level, in_flight):
    maker.every(0, 4, 0.2, lambda time_s: status(uptime_s=100 + int(time_s)))
    maker.every(4, 8, 0.2, lambda time_s: status(uptime_s=int(time_s) - 4, reset_cause=cause))
    finding = only()
    assert (finding.time_s, finding.level, finding.code) == (4.0, level, "board_reset")
    assert finding.fields["in_flight"] is in_flight


def test_board_reset_before_the_log_began(maker, only):
    maker.every(0, 1, 0.2, status(reset_cause=WATCHDOG | RESTORED))
    finding = only()
    assert (finding.level, finding.fields["cause"]) == ("alarm", "watchdog, state restored")


def test_board_silent_in_flight(maker, found):
    maker.put(0, LinkStateCommand("arduino", True))
    maker.every(0, 4, 0.2, ARMED)
    # A gap of no time: the program stood still and logged the loss and its end together.
    maker.put(2.0, LinkStateCommand("arduino", False))
    maker.put(2.001, LinkStateCommand("arduino", True))
    # What the cog publishes for a lost board: whether it is armed is unknown.
    maker.put(4.2, State(None, False, False, False), BOARD)
    maker.put(4.2, LinkStateCommand("arduino", False))
    maker.put(5.4, LinkStateCommand("arduino", True))
    maker.every(5.4, 8, 0.2, ARMED)
    assert found() == [(4.2, "alarm", "board_silent", 1.2)]


def test_raspilot_silent_and_a_late_loop_and_damaged_frames(maker, tmp_path):
    maker.every(0, 10, 0.2, ARMED)
    maker.every(0, 2, 0.2, status(frame_errors=5))
    maker.every(2, 4, 0.2, status(flags=GOOD & ~HEARD, frame_errors=5))
    maker.every(4, 6, 0.2, status(late_us=1200, frame_errors=7))
    maker.put(5.1, status(late_us=3100, frame_errors=7), BOARD)
    maker.every(6, 8, 0.2, status(frame_errors=160))
    # The counters of a board restart at a reset; these are not more frames.
    maker.every(8, 10, 0.2, status(frame_errors=3))
    assert [
        (each.time_s, each.level, each.code, dict(each.fields))
        for each in findings(maker.log(tmp_path))
    ] == [
        (2.0, "alarm", "raspilot_silent", {}),
        (4.0, "warning", "board_loop_late", {"late_us": 3100}),
        (4.0, "warning", "frames_damaged", {"count": 155}),
    ]


def test_lost_links(maker, found):
    maker.quiet_flight(40.0, armed=(5, 35))
    for link, lost_s, back_s in (("mission_control", 10, 22), ("android", 6, 36)):
        maker.put(lost_s + 0.01, LinkStateCommand(link, False))
        maker.put(back_s + 0.01, LinkStateCommand(link, True))
    maker.put(31, LinkStateCommand("ground", False))
    assert found() == [(6.0, "warning", "phone_lost", 30.0), (10.0, "warning", "ground_lost", 12.0)]


def test_a_ground_that_leaves_after_landing_is_an_info(maker, found):
    maker.quiet_flight(40.0, armed=(5, 15))
    maker.put(30, LinkStateCommand("mission_control", False))
    assert found() == [(30.0, "info", "ground_lost", 9.9)]


def test_a_refused_phone_with_its_host(maker, only):
    for number, host in enumerate([None, "192.0.2.7", "192.0.2.7", None, 7]):
        maker.put(5.0 + number, TelemetryCommand({"android": {"competitor": host}}, number))
    finding = only()
    assert (finding.time_s, finding.level, finding.length_s) == (1.0, "warning", 2.0)
    assert (finding.code, finding.fields) == ("phone_refused", {"host": "192.0.2.7"})


def test_missing_readings(maker, tmp_path):
    maker.every(0, 30, 0.2, ARMED)
    for begin_s, end_s in ((0, 10), (10.8, 30)):
        maker.every(begin_s, end_s, 0.02, OrientationCommand(1.0, 2.0, 3.0))
    maker.every(0, 12, 1.0, LocationCommand(50.0, 14.0), PHONE)
    maker.every(20, 22, 1.0, LocationCommand(50.0, 14.0), PHONE)
    found = findings(maker.log(tmp_path))
    assert {each.code for each in found} == {"reading_missing"}
    assert [(round(each.time_s, 2), each.level, each.subject) for each in found] == [
        (9.98, "alarm", "attitude"),
        (11.0, "warning", "location"),
        (21.0, "warning", "location"),
    ]
    assert [each.span.is_open for each in found] == [False, False, True]


def test_a_slow_source_is_not_missing(maker, found):
    maker.every(0, 60, 0.5, ARMED)
    maker.every(0, 60, 5.0, LocationCommand(50.0, 14.0), PHONE)
    assert found() == []


def test_low_battery_once(maker, only):
    maker.put(0, AndroidBatteryLowCommand(14.5, True))
    maker.put(1, AndroidBatteryLowCommand(20, False))
    maker.line(0, 4, "AndroidBatteryProvider", "low", code="battery_low", level=14.5)
    finding = only()
    assert (finding.level, finding.code) == ("alarm", "battery_low")
    assert finding.fields == {"level": 14.5}


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


def test_findings_are_bounded(maker, tmp_path):
    for second in range(400):
        maker.put(second, State("FBW", True, False, second % 2 == 0), BOARD)
    for number in range(300):
        maker.put(400, answered("up.arm", "refused", f"reason {number}"))
    maker.line(400, 4, "Up", "x" * 10_000)
    found = findings(maker.log(tmp_path))
    codes = [each.code for each in found]
    assert codes.count("failsafe") == codes.count("command_refused") == 51
    assert found[50].fields["more"] == 149
    assert max(len(each.text) for each in found) < 600


def test_strange_messages_make_no_fault(tmp_path):
    maker = LogMaker()
    nonsense = [None, True, False, "x", [1], {"a": [1]}, 10**30, -1, 0.5, 1]
    topics = (
        *("up.rx.update", "up.flight.state", "arduino.status", "up.link.state", "up.panic"),
        *("up.location.update", "up.altitude.change", "android.battery", "android.battery.low"),
        *("arduino.pids.tunings", "arduino.pids.values", "up.system.state", "black_box.mark"),
        *("up.telemetry.update", "up.command.answered", "log"),
    )
    keys = (
        *("valid", "armed", "failsafe", "flight_mode", "flags", "uptime_s", "late_us", "pids"),
        *("frame_errors", "reset_cause", "link", "connected", "latitude", "longitude", "level"),
        *("low", "panic", "utilization", "mode", "counters", "vetoes", "text", "message", "name"),
        *("code", "fields", "outcome", "untold", "_origin"),
    )
    for number, each in enumerate(nonsense):
        for topic in topics:
            maker.add(number, topic, **dict.fromkeys(keys, each))
    for code in ("event_loop_blocked", "recording_stopped", "messages_dropped"):
        maker.add(10, "log", level=4, code=code, fields={"count": [], "ms": "x", "call": None})
    log = maker.log(tmp_path)
    assert all("\n" not in each.text for each in findings(log))
    summary.summarise(log)


def test_a_shared_context_gives_the_same_result(maker, tmp_path):
    maker.quiet_flight()
    log = maker.log(tmp_path)
    context = FlightContext(log)
    assert findings(log, context) == findings(log)
    assert summary.summarise(log, context) == summary.summarise(log)
    assert len({detector.__name__ for detector in DETECTORS}) == len(DETECTORS) == 22
