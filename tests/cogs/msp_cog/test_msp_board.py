"""The board's readings on the bus, and what the board is sent."""

import pytest
from msp_cog import messages
from msp_cog.modules.msp_board import OVERRIDDEN_VALID
from twisted.logger import capturedLogs

from tests.cogs.msp_cog.recorded import ANGLE, ARMED, OVERRIDE, RECEIVER_FAILSAFE, status
from tests.cogs.msp_cog.rig import Rig
from up.commands.arming_commands import ArmCommand
from up.commands.flight_state_command import FlightBatteryCommand, FlightModeCommand
from up.commands.location_command import LocationCommand
from up.commands.output_command import SetpointCommand
from up.commands.refusal import CommandRefusedError
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand

AUTO = ARMED | ANGLE | OVERRIDE
SETPOINT = SetpointCommand(20.0, -5.0, throttle_us=1600)


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path)
    made.rx = []
    made.up.command_executor.register_command(RXCommand, made.rx.append)
    yield made
    made.stop()


def at(rig, boxes, reasons=0):
    rig.answers[messages.STATUS] = status(boxes, reasons)
    rig.advance(0.2)
    rig.heard.clear()


def test_readings_state_and_position(rig):
    rig.advance(1.0)
    attitude = rig.orientation.reading
    assert attitude.source == "msp" and attitude.value.sequence > 20
    value = attitude.value
    assert (value.roll_deg, value.pitch_deg, value.yaw_deg) == (30.0, 5.1, 40.0)
    assert value.yaw_rate_deg_s == pytest.approx(1 / 16.4)
    assert rig.rx[-1] == RXCommand(1600, 1400, 1000, 1550, 1500, 2000, ALL_VALID)
    fix = rig.location.reading.value
    assert (fix.latitude_deg, fix.longitude_deg) == (50.1234567, 14.7654321)
    assert (fix.altitude_m, fix.speed_m_s, fix.bearing_deg) == (370, 13.99, 44.9)
    assert (fix.satellites, fix.age_ms) == (12, 200.0)
    content = rig.board.telemetry_content
    assert content["armed"] is False and content["flight_mode"] == "FBW"
    assert content["servo"] == {"ailerons": 1616, "elevator": 1609, "throttle": 1055,
                                "rudder": 1500}  # fmt: skip
    assert content["msp"] == {"connected": True, "arming_disabled": []}
    at(rig, ARMED | ANGLE)
    assert rig.board.is_armed and rig.board.is_in_flight


def test_an_unchanged_position_is_published_once_a_second(rig):
    heard = []
    rig.location.subscribe(heard.append)
    rig.advance(3.0)
    assert 2 <= len(heard) <= 4


@pytest.mark.parametrize(
    "number", [messages.RC, messages.MOTOR, messages.SERVO, messages.ANALOG, messages.RAW_GPS]
)
def test_impossible_values_are_dropped_and_counted(rig, number):
    heard = []
    rig.up.command_executor.add_observer(lambda command, _origin: heard.append(command))
    rig.answers[number] = b"\xff" * 32
    rig.advance(0.5)
    assert rig.board.counters["invalid"] >= 4
    kinds = {RXCommand: messages.RC, ServoCommand: messages.MOTOR,
             FlightBatteryCommand: messages.ANALOG, LocationCommand: messages.RAW_GPS}  # fmt: skip
    for each in heard:
        assert kinds.get(type(each)) != number
        assert not isinstance(each, ServoCommand) or number != messages.SERVO


def test_a_set_point_becomes_sticks_by_the_boards_curve(rig):
    at(rig, AUTO)
    rig.execute(SETPOINT)
    (payload,) = sent(rig)
    ailerons, elevator, throttle, rudder = (
        int.from_bytes(payload[n : n + 2], "little") for n in (0, 2, 4, 6)
    )
    roll, pitch = rig.board.curves
    assert roll.angle_deg((ailerons - 1500) / 500) == pytest.approx(20.0, abs=0.2)
    assert pitch.angle_deg((elevator - 1500) / 500) == pytest.approx(5.0, abs=0.2)
    assert (throttle, rudder) == (1600, 1500)
    rig.advance(0.2)
    assert rig.board.state.flight_mode == "SETPOINT"
    # While it acts, the board reports it as the sticks.
    assert rig.rx[-1].valid == OVERRIDDEN_VALID
    rig.advance(0.4)
    assert rig.board.state.flight_mode == "FBW" and rig.rx[-1].valid == ALL_VALID


def sent(rig):
    rig.advance(0.06)
    return rig.take(messages.SET_RAW_RC)


def test_a_throttle_that_is_the_pilots_is_not_sent(rig):
    at(rig, AUTO)
    rig.execute(SetpointCommand(0.0, 0.0))
    assert [len(each) for each in sent(rig)] == [4]


@pytest.mark.parametrize(
    ("boxes", "reasons", "command"),
    [
        (ARMED | ANGLE, 0, SETPOINT),
        (ARMED | OVERRIDE, 0, SETPOINT),
        (AUTO, RECEIVER_FAILSAFE, SETPOINT),
        (AUTO, 0, SetpointCommand(20.0, 0.0, is_failsafe=True)),
    ],
    ids=["switch", "no ANGLE", "failsafe", "for the failsafe"],
)
def test_attack_a_set_point_goes_nowhere_without_the_switch_or_the_receiver(
    rig, boxes, reasons, command
):
    at(rig, AUTO)
    rig.execute(SETPOINT)
    assert sent(rig)
    at(rig, boxes, reasons)
    rig.execute(command)
    assert sent(rig) == []


@pytest.mark.parametrize(
    ("number", "payload"),
    [
        (messages.VARIANT, b"INAV"),
        (messages.VERSION, bytes((4, 5, 1))),
        (messages.VERSION, bytes((25, 12, 2))),
        (messages.RECEIVER_MAP, bytes((1, 2, 3, 0))),
        (messages.RC_TUNING, bytes(23)),
    ],
    ids=["other firmware", "4.5", "2025.12", "TAER", "rates"],
)
def test_attack_a_board_that_would_not_follow_as_meant_gets_no_set_point(rig, number, payload):
    """Older ones hold the last set-point when this program is killed."""
    good = rig.answers[number]
    rig.answers[number] = payload
    rig.advance(1.2)
    assert list(rig.up.vetoes.own) == ["msp board"]
    at(rig, AUTO)
    rig.execute(SETPOINT)
    assert sent(rig) == [] and not rig.board.state.is_auto
    rig.answers[number] = good
    rig.advance(1.2)
    assert rig.up.vetoes.own == {}
    rig.execute(SETPOINT)
    assert sent(rig)


def test_attack_a_veto_forbids_arming_and_never_disarms(rig):
    rig.advance(0.4)
    assert rig.take(messages.SET_ARMING_DISABLED) == [b"\x00"]
    rig.up.vetoes.set("test", "no")
    rig.advance(0.2)
    assert rig.take(messages.SET_ARMING_DISABLED) == [b"\x01"]
    rig.up.vetoes.clear("test")
    rig.advance(0.2)
    assert rig.take(messages.SET_ARMING_DISABLED) == [b"\x00"]
    at(rig, ARMED | ANGLE)
    rig.up.vetoes.set("test", "no")
    rig.advance(0.4)
    assert rig.take(messages.SET_ARMING_DISABLED) == []


def test_a_program_that_ends_leaves_arming_to_the_board(tmp_path):
    rig = Rig(tmp_path)
    rig.up.vetoes.set("test", "no")
    rig.advance(0.4)
    assert rig.take(messages.SET_ARMING_DISABLED) == [b"\x01"]
    rig.stop()
    assert rig.take(messages.SET_ARMING_DISABLED) == [b"\x00"]


def test_attack_nothing_arms_and_no_mode_is_taken_without_the_switch(rig):
    executor = rig.up.command_executor
    assert not executor.handlers_of(ArmCommand)
    (take,) = executor.handlers_of(FlightModeCommand)
    at(rig, ARMED | ANGLE)
    with pytest.raises(CommandRefusedError) as refused:
        take(FlightModeCommand("LOITER"))
    assert refused.value.detail == "not_at_auto"
    at(rig, AUTO)
    assert take(FlightModeCommand("LOITER")) is None


def test_a_lost_receiver_invalidates_the_sticks(rig):
    at(rig, ARMED | ANGLE, RECEIVER_FAILSAFE)
    assert rig.rx[-1].valid == 0 and rig.board.state.is_failsafe
    assert rig.up.vetoes.all == []
    at(rig, ANGLE, RECEIVER_FAILSAFE)
    assert rig.up.vetoes.all == ["msp: receiver_failsafe"]


def test_a_silent_board_is_unknown_until_it_answers_again(rig):
    rig.advance(0.5)
    at(rig, AUTO)
    answers, rig.answers = rig.answers, {}
    rig.advance(1.0)
    assert not rig.board.connected and rig.board.is_armed is None and rig.board.curves is None
    assert rig.up.vetoes.all == [f"msp: {rig.board.absent}"]
    rig.execute(SETPOINT)
    assert sent(rig) == []
    rig.answers = answers
    rig.advance(1.0)
    assert rig.board.connected and rig.board.is_armed


def test_a_port_where_nothing_answers_by_msp_is_reported_once(tmp_path):
    rig = Rig(tmp_path)
    rig.answers = {}
    with capturedLogs() as events:
        for _ in range(7):
            rig.port.send(b"noise")
            rig.advance(1.0)
    assert [each["code"] for each in events if "code" in each].count("no_answer") == 1
    rig.stop()


def test_refused_messages_and_lost_answers_do_not_stop_the_others(rig):
    rig.refused = {messages.SERVO, messages.RAW_GPS}
    rig.lost_every = 7
    rig.advance(0.5)
    before = rig.orientation.reading.value.sequence
    rig.advance(10.0)
    assert rig.board.connected and rig.orientation.reading.value.sequence - before > 350
