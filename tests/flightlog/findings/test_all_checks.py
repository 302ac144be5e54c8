from tests.flightlog.flights import (
    ALL_VALID,
    BOARD,
    LinkStateCommand,
    RXCommand,
)
from tests.flightlog.flights import FlightStateCommand as State
from tests.flightlog.logs import LogMaker
from up.commands.answer_commands import CommandAnsweredCommand
from up_flightlog.findings import summary
from up_flightlog.findings.all_checks import ALL_CHECKS, findings
from up_flightlog.findings.flight_context import FlightContext


def test_a_quiet_flight_has_no_findings(maker, found):
    maker.quiet_flight()
    maker.put(8.05, RXCommand(1500, 1500, 1000, 1500, 1000, 2000, ALL_VALID - 1), BOARD)
    for link in ("arduino", "mission_control", "android"):
        maker.put(19.8, LinkStateCommand(link, False))
    assert found() == []


def test_findings_are_bounded(maker, tmp_path):
    for second in range(400):
        maker.put(second, State("FBW", True, False, second % 2 == 0), BOARD)
    for number in range(300):
        maker.put(
            400,
            CommandAnsweredCommand("ground", "up.arm", "1", "nack", "refused", f"reason {number}"),
        )
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
    assert len({check.__name__ for check in ALL_CHECKS}) == len(ALL_CHECKS) == 22
