"""Faults of the board: receiver, IMU, resets, its loop and its line."""

import pytest

from tests.flightlog.flights import (
    ALL_VALID,
    BOARD,
    GOOD,
    HEARD,
    IMU,
    RECEIVER,
    RESTORED,
    WATCHDOG,
    LinkStateCommand,
    RXCommand,
    TelemetryCommand,
    status,
)
from tests.flightlog.flights import FlightStateCommand as State
from up_flightlog.findings.all_checks import findings

ARMED = State("FBW", True, False, False)


def rx(valid: int) -> RXCommand:
    return RXCommand(1500, 1500, 1000, 1500, 1000, 2000, valid)


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


def test_an_impossible_validity_of_a_damaged_log_is_no_loss(maker, found):
    maker.every(0, 2, 0.1, rx(ALL_VALID))
    for number, valid in enumerate((64, -1, 0.5, "0", None)):
        maker.add(2.0 + number / 10, "up.rx.update", valid=valid)
    maker.every(3, 5, 0.1, rx(ALL_VALID))
    assert found() == []


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


def test_the_flight_battery_was_low(maker, found):
    maker.every(0, 10, 0.2, ARMED)
    for time_s in range(10):
        below = {"flight_battery_low": time_s >= 4, "flight_battery_critical": 6 <= time_s < 8}
        maker.put(time_s, TelemetryCommand({"arduino": below}, time_s))
    assert found() == [
        (4.0, "alarm", "flight_battery_low", 5.8),
        (6.0, "alarm", "flight_battery_critical", 2.0),
    ]


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
