import pytest

from tests.up.flight_log.flights import (
    ALL_VALID,
    BOARD,
    FAILSAFE,
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
    FlightStateCommand,
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
from tests.up.flight_log.logs import LogMaker
from up.commands.answer_commands import CommandAnsweredCommand
from up.flight_log import summary
from up.flight_log.facts import Facts
from up.flight_log.wrong import Wrong
from up.flight_log.wrongs import JUDGMENTS, wrongs


@pytest.fixture
def maker():
    return FlightMaker()


def told(maker, folder, is_finished=True):
    return wrongs(maker.log(folder, is_finished))


def only(maker, folder) -> Wrong:
    found = told(maker, folder)
    assert len(found) == 1, found
    return found[0]


def texts(maker, folder) -> list[tuple[float, str, str]]:
    return [(round(each.time_s, 1), each.level, each.text) for each in told(maker, folder)]


def rx(valid: int) -> RXCommand:
    return RXCommand(1500, 1500, 1000, 1500, 1000, 2000, valid)


def test_nothing_is_wrong_with_a_quiet_flight(maker, tmp_path):
    maker.quiet_flight()
    maker.put(19.8, LinkStateCommand("arduino", False))
    maker.put(19.8, LinkStateCommand("mission_control", False))
    maker.put(19.9, LinkStateCommand("android", False))
    assert told(maker, tmp_path) == []


def test_a_receiver_that_is_lost_in_flight_is_an_alarm(maker, tmp_path):
    maker.quiet_flight(armed=(0, 20))
    for number in range(13):
        maker.put(8.05 + number * 0.1, rx(0), BOARD)
    # The quiet flight continues in between: as if the connection came and went.
    found = told(maker, tmp_path)
    assert [each.level for each in found] == ["alarm"]
    assert found[0].text == "the receiver was lost for 1.2 s"
    assert found[0].time_s == pytest.approx(8.05)


def test_a_phone_that_was_refused_is_told_with_its_host(maker, tmp_path):
    maker.quiet_flight()
    for number, host in enumerate([None, "192.0.2.7", "192.0.2.7", None, 7]):
        maker.put(5.0 + number, TelemetryCommand({"android": {"competitor": host}}, number))
    (wrong,) = [each for each in told(maker, tmp_path) if "phone" in each.text]
    assert (wrong.time_s, wrong.level, wrong.length_s) == (6.0, "warning", 2.0)
    assert "192.0.2.7" in wrong.text


def test_one_bad_pulse_is_no_loss(maker, tmp_path):
    maker.quiet_flight(armed=(0, 20))
    maker.put(8.05, rx(ALL_VALID - 1), BOARD)
    assert told(maker, tmp_path) == []


def test_channels_that_are_lost_are_named(maker, tmp_path):
    maker.every(0, 2, 0.02, rx(ALL_VALID))
    maker.every(2, 3, 0.02, rx(ALL_VALID & ~0b110000))
    maker.every(3, 5, 0.02, rx(ALL_VALID))
    assert only(maker, tmp_path) == Wrong(2.0, "warning", "no valid pulses of aux1, aux2 for 1.0 s")


def test_a_receiver_before_its_first_pulse_and_after_the_last_landing_is_no_alarm(maker, tmp_path):
    maker.every(0, 5, 0.1, rx(0))
    maker.every(5, 15, 0.1, rx(ALL_VALID))
    maker.every(15, 20, 0.1, rx(0))
    maker.every(0, 20, 0.2, FlightStateCommand("FBW", False, False, False))
    found = only(maker, tmp_path)
    assert found.level == "info"
    assert found.text == "the receiver was lost for 4.9 s until the end"


def test_without_inputs_the_boards_word_counts(maker, tmp_path):
    maker.every(0, 4, 0.2, status())
    maker.every(4, 6, 0.2, status(flags=GOOD & ~RECEIVER))
    maker.every(6, 8, 0.2, status())
    assert only(maker, tmp_path).text == "the receiver was lost for 2.0 s"


def test_failsafe_and_imu(maker, tmp_path):
    maker.every(0, 4, 0.2, status())
    maker.every(4, 5, 0.2, status(flags=GOOD & ~IMU))
    maker.every(5, 8, 0.2, status())
    maker.every(0, 6, 0.2, FlightStateCommand("FBW", True, False, False))
    maker.every(6, 7, 0.2, FlightStateCommand("FBW", True, False, True))
    maker.every(7, 8, 0.2, FlightStateCommand("FBW", True, False, False))
    assert texts(maker, tmp_path) == [
        (4.0, "alarm", "the IMU was invalid for 1.0 s"),
        (6.0, "alarm", "the receiver's failsafe acted for 1.0 s"),
    ]


def test_a_reset_in_flight_is_an_alarm_with_its_cause(maker, tmp_path):
    maker.every(0, 4, 0.2, lambda time_s: status(uptime_s=100 + int(time_s)))
    cause = WATCHDOG | RESTORED
    maker.every(4, 8, 0.2, lambda time_s: status(uptime_s=int(time_s) - 4, reset_cause=cause))
    assert only(maker, tmp_path) == Wrong(
        4.0, "alarm", "the board was reset in flight (watchdog, state restored)"
    )


def test_a_reset_on_the_ground_is_a_warning(maker, tmp_path):
    maker.every(0, 4, 0.2, lambda time_s: status(uptime_s=100 + int(time_s)))
    maker.every(4, 8, 0.2, lambda time_s: status(uptime_s=int(time_s) - 4, reset_cause=2))
    assert only(maker, tmp_path) == Wrong(4.0, "warning", "the board was reset (external)")


def test_a_reset_before_the_log_began_is_told_where_it_was_in_flight(maker, tmp_path):
    maker.every(0, 1, 0.2, status(reset_cause=WATCHDOG | RESTORED))
    assert only(maker, tmp_path).level == "alarm"


def test_a_board_that_is_silent_in_flight(maker, tmp_path):
    maker.put(0, LinkStateCommand("arduino", True))
    maker.every(0, 4, 0.2, FlightStateCommand("FBW", True, False, False))
    # What the cog publishes for a lost board: whether it is armed is unknown.
    maker.put(4.2, FlightStateCommand(None, False, False, False), BOARD)
    maker.put(4.2, LinkStateCommand("arduino", False))
    maker.put(5.4, LinkStateCommand("arduino", True))
    maker.every(5.4, 8, 0.2, FlightStateCommand("FBW", True, False, False))
    assert texts(maker, tmp_path) == [(4.2, "alarm", "the board was silent for 1.2 s")]


def test_a_loss_of_no_time_is_none(maker, tmp_path):
    maker.put(0, LinkStateCommand("arduino", True))
    maker.every(0, 4, 0.2, FlightStateCommand("FBW", True, False, False))
    maker.put(2.0, LinkStateCommand("arduino", False))
    maker.put(2.001, LinkStateCommand("arduino", True))
    assert texts(maker, tmp_path) == []


def test_gains_of_single_precision_are_the_same_and_the_first_told_are_no_change(maker, tmp_path):
    maker.every(0, 5, 0.5, FlightStateCommand("FBW", True, False, False))
    maker.put(1, PIDTuningsCommand(None, gains(0.1)), GROUND)
    maker.put(2, PIDTuningsValuesCommand(gains(0.10000000149011612)), BOARD)
    maker.put(3, PIDTuningsCommand(None, gains(0.1)), GROUND)
    by = "by mission_control (pilot)"
    assert texts(maker, tmp_path) == [
        (1.0, "warning", f"gains were set in flight {by}; which flew before is not told"),
        (3.0, "warning", f"gains were changed in flight {by}: to what they were"),
    ]


def test_a_board_that_hears_nothing_and_a_late_loop_and_bad_frames(maker, tmp_path):
    maker.every(0, 10, 0.2, FlightStateCommand("FBW", True, False, False))
    maker.every(0, 2, 0.2, status(frame_errors=5))
    maker.every(2, 4, 0.2, status(flags=GOOD & ~HEARD, frame_errors=5))
    maker.every(4, 6, 0.2, status(late_us=1200, frame_errors=7))
    maker.put(5.1, status(late_us=3100, frame_errors=7), BOARD)
    maker.every(6, 8, 0.2, status(frame_errors=160))
    # The counters of a board restart at a reset; these are not more frames.
    maker.every(8, 10, 0.2, status(frame_errors=3))
    assert texts(maker, tmp_path) == [
        (2.0, "alarm", "the board did not hear Raspilot for 2.0 s"),
        (4.0, "warning", "the board's control loop was up to 3.1 ms late"),
        (4.0, "warning", "the board dropped 155 damaged frames of the serial line"),
    ]


def test_links_that_were_lost(maker, tmp_path):
    maker.quiet_flight(40.0, armed=(5, 35))
    for link, gone_s, back_s in (("mission_control", 10, 22), ("android", 6, 36)):
        maker.put(gone_s + 0.01, LinkStateCommand(link, False))
        maker.put(back_s + 0.01, LinkStateCommand(link, True))
    maker.put(31, LinkStateCommand("ground", False))
    assert texts(maker, tmp_path) == [
        (6.0, "warning", "the phone was gone for 30 s"),
        (10.0, "warning", "the link to the ground was lost for 12 s"),
    ]


def test_a_ground_that_leaves_after_landing_is_an_information(maker, tmp_path):
    maker.quiet_flight(40.0, armed=(5, 15))
    maker.put(30, LinkStateCommand("mission_control", False))
    assert texts(maker, tmp_path) == [
        (30.0, "info", "the link to the ground was lost for 9.9 s until the end")
    ]


def test_readings_that_stay_away(maker, tmp_path):
    maker.every(0, 30, 0.2, FlightStateCommand("FBW", True, False, False))
    for begin_s, end_s in ((0, 10), (10.8, 30)):
        maker.every(begin_s, end_s, 0.02, OrientationCommand(1.0, 2.0, 3.0))
    maker.every(0, 12, 1.0, LocationCommand(50.0, 14.0), PHONE)
    maker.every(20, 22, 1.0, LocationCommand(50.0, 14.0), PHONE)
    assert texts(maker, tmp_path) == [
        (10.0, "alarm", "no attitude came for 0.82 s"),
        (11.0, "warning", "no location came for 9.0 s"),
        (21.0, "warning", "no location came for 9.0 s until the end"),
    ]


def test_a_source_that_is_slow_by_nature_is_not_missed(maker, tmp_path):
    maker.every(0, 60, 0.5, FlightStateCommand("FBW", True, False, False))
    maker.every(0, 60, 5.0, LocationCommand(50.0, 14.0), PHONE)
    assert told(maker, tmp_path) == []


def test_a_low_battery(maker, tmp_path):
    maker.put(0, AndroidBatteryLowCommand(14.5, True))
    maker.put(1, AndroidBatteryLowCommand(20, False))
    maker.line(0, 4, "AndroidBatteryProvider", "the phone's battery is low: 14.5 percent")
    assert only(maker, tmp_path) == Wrong(0.0, "alarm", "the phone's battery was low: 14.5 percent")


def test_panic(maker, tmp_path):
    maker.put(0, PanicCommand(False, 50))
    maker.put(1, PanicCommand(True, 150, 97.5))
    maker.put(1.5, PanicCommand(True, 150, 99.0))
    maker.put(2, PanicCommand(False, 50, 60.0))
    assert only(maker, tmp_path) == Wrong(
        1.0, "warning", "Panic Mode for 1.0 s, at 97.5 percent of load"
    )


def gains(p: float) -> dict:
    axes = {axis: {"p": p, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator")}
    return {"ratePIDs": axes, "stabPIDs": axes}


def test_gains_that_were_refused_in_flight_flew_never(maker, tmp_path):
    maker.every(0, 10, 0.5, FlightStateCommand("FBW", True, False, False))
    maker.put(0.5, PIDTuningsValuesCommand(gains(1.0)), BOARD)
    for time_s, gain, outcome in ((3, 2.0, "nack"), (5, 1.5, "ack")):
        maker.put(time_s, PIDTuningsCommand(None, gains(gain)), GROUND)
        answer = CommandAnsweredCommand("ground", PIDTuningsCommand.NAME, "7", outcome)
        maker.put(time_s + 0.1, answer)
    warnings = [each for each in texts(maker, tmp_path) if each[1] == "warning"]
    assert [time_s for time_s, *_ in warnings] == [5.0]
    assert " 1 to 1.5" in warnings[0][2]


def test_gains_that_were_changed_in_flight_are_told_with_their_difference(maker, tmp_path):
    def state(time_s):
        return FlightStateCommand("FBW", False, 2 <= time_s < 6, False)

    maker.every(0, 10, 0.5, state)
    maker.put(0.5, PIDTuningsValuesCommand(gains(1.0)), BOARD)
    maker.put(1, PIDTuningsCommand(None, gains(2.0)), GROUND)
    maker.put(2.5, PIDTuningsCommand(True, None), GROUND)
    changed = gains(2.0)
    changed["ratePIDs"] = {**changed["ratePIDs"], "elevator": {"p": 2.5, "i": 0, "d": 0.0}}
    maker.put(3, PIDTuningsCommand(None, changed), GROUND)
    maker.put(4, PIDTuningsCommand(None, changed), GROUND)
    maker.put(7, PIDTuningsCommand(None, gains(9.0)), GROUND)
    by = "gains were changed in flight by mission_control (pilot)"
    assert texts(maker, tmp_path) == [
        (3.0, "warning", f"{by}: rate pitch P 2 to 2.5"),
        (4.0, "warning", f"{by}: to what they were"),
    ]


def test_who_held_the_reactor_is_told_with_the_count(maker, tmp_path):
    text = "SlowModule holds the reactor for more than 20 ms, and with it everything (said once)"
    maker.line(1, 4, "ReactorMonitor", text)
    maker.put(2, TelemetryCommand({"counters": {"reactor": {"SlowModule": 37}}}, 1))
    assert only(maker, tmp_path).text == (
        "Raspilot was held up for more than 20 ms by SlowModule, 37 times in all"
    )


@pytest.mark.parametrize(
    ("count", "level", "more"),
    [
        (3, "info", "while it started"),
        (4, "warning", "while it started, and once in flight"),
        (9, "warning", "while it started, and 6 times in flight"),
    ],
)
def test_who_held_the_reactor_while_it_started_did_no_harm(maker, tmp_path, count, level, more):
    maker.line(0.1, 4, "ReactorMonitor", "SlowModule holds the reactor for more than 20 ms, and so")
    maker.every(1, 6, 0.5, lambda time_s: FlightStateCommand("FBW", False, False, False))
    maker.put(1.2, TelemetryCommand({"counters": {"reactor": {"SlowModule": 3}}}, 1))
    maker.put(5, TelemetryCommand({"counters": {"reactor": {"SlowModule": count}}}, 2))
    found = only(maker, tmp_path)
    text = f"Raspilot was held up for more than 20 ms by SlowModule {more}"
    assert (found.level, found.text) == (level, text)


def test_what_the_recorder_says_of_the_disk(maker, tmp_path):
    text = "the flight is not recorded: /var/x: No space left on device; tried again every minute"
    maker.line(1, 4, "BlackBox", text)
    maker.line(1.5, 2, "BlackBox", "records again, into /var/y.mcap; 250 messages are lost")
    maker.line(1.6, 3, "BlackBox", "12 messages were not recorded: the disk is too slow")
    maker.line(1.7, 3, "BlackBox", "/var/y.mcap was removed; a new file is begun")
    assert texts(maker, tmp_path) == [
        (0.0, "alarm", "recording ended: /var/x: No space left on device"),
        (0.5, "warning", "recorded again: 250 messages are lost"),
        (0.6, "warning", "12 messages were not recorded: the disk is too slow"),
        (0.7, "warning", "/var/y.mcap was removed; a new file is begun"),
    ]


def test_a_refused_arming_and_errors_of_the_log(maker, tmp_path):
    maker.line(0, 2, "CommandExecutor", "ArduinoArming refused up.arm: the throttle is not low")
    maker.line(1, 2, "CommandExecutor", "Other refused android.speak: no phone")
    for time_s in (2, 3, 4):
        maker.line(time_s, 4, "Up", "module\nx\x1b[31m failed")
    maker.line(3, 3, "Up", "only a warning")
    maker.line(4, 5, "", "fatal")
    assert texts(maker, tmp_path) == [
        (0.0, "info", "up.arm was refused: the throttle is not low"),
        (2.0, "warning", "Up: module\\nx\\x1b[31m failed (3 times)"),
        (4.0, "warning", "fatal"),
    ]


def test_black_box_mode_that_nobody_wished(maker, tmp_path):
    for time_s, mode in ((0, "flight controller"), (1, "black box (provisional)"), (2, "auto")):
        maker.put(time_s, SystemStateCommand(1.0, 1.0, (), False, mode))
    assert only(maker, tmp_path).text == (
        "provisionally in Black Box Mode for 1.0 s: no frame came from the board"
    )


def test_a_hole_in_everything(maker, tmp_path):
    maker.every(0, 2, 0.2, FlightStateCommand("FBW", True, False, False))
    maker.every(6, 8, 0.2, FlightStateCommand("FBW", True, False, False))
    assert texts(maker, tmp_path) == [(1.8, "alarm", "nothing at all was logged for 4.2 s")]


def test_a_log_that_was_cut_off(maker, tmp_path):
    maker.quiet_flight()
    found = told(maker, tmp_path, is_finished=False)
    assert [each.level for each in found] == ["warning"]
    assert found[0].time_s == pytest.approx(19.9)
    assert "the recording was cut off" in found[0].text


def test_what_comes_without_end_stays_short(maker, tmp_path):
    for second in range(400):
        maker.put(second, FlightStateCommand("FBW", True, False, second % 2 == 0), BOARD)
    found = told(maker, tmp_path)
    assert len(found) == 51
    assert found[-1].text.endswith("(and 149 more of this kind)")
    maker = FlightMaker()
    maker.line(0, 4, "Up", "x" * 10_000)
    assert len(only(maker, tmp_path).text) < 600


def test_strange_messages_make_no_fault(tmp_path):
    maker = LogMaker()
    nonsense = [None, True, False, "x", [1], {"a": [1]}, 10**30, -1, 0.5, 1]
    topics = (
        "up.rx.update",
        "up.flight.state",
        "arduino.status",
        "up.link.state",
        "up.location.update",
        "up.altitude.change",
        "android.battery",
        "android.battery.low",
        "up.panic",
        "arduino.pids.tunings",
        "arduino.pids.values",
        "up.system.state",
        "up.telemetry.update",
        "black_box.mark",
        "log",
    )
    keys = ("valid", "armed", "failsafe", "flight_mode", "flags", "uptime_s", "late_us", "pids")
    more = ("frame_errors", "reset_cause", "link", "connected", "latitude", "longitude", "level")
    last = ("low", "panic", "utilization", "mode", "counters", "vetoes", "text", "message", "name")
    for number, each in enumerate(nonsense):
        for topic in topics:
            maker.add(number, topic, **dict.fromkeys((*keys, *more, *last, "_origin"), each))
    log = maker.log(tmp_path)
    assert all("\n" not in each.text for each in wrongs(log))
    summary.summarise(log)


def test_the_summary_spares_a_second_look(maker, tmp_path):
    maker.quiet_flight()
    log = maker.log(tmp_path)
    facts = Facts(log)
    assert summary.wrongs(log, facts) == wrongs(log)
    assert summary.summarise(log, facts) == summary.summarise(log)


def test_every_judgment_is_named_once():
    names = [judge.__name__ for judge in JUDGMENTS]
    assert len(names) == len(set(names)) == 23
    assert all(judge.__doc__ for judge in JUDGMENTS)


def test_flags_are_the_boards():
    assert status(flags=FAILSAFE).is_failsafe
