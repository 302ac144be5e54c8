"""The profile: the Arduino's values are the truth, airframe.yml changes those that it names."""

import struct

import pytest
from arduino_cog.commands.arduino_commands import ArduinoProfileRequestCommand
from twisted.logger import capturedLogs, globalLogPublisher

from tests.cogs.arduino_cog.board import PROFILE, PROFILE_FORMAT, Ground
from up.commands.arming_commands import ArmCommand
from up.commands.board_schema import REASONS, Reason
from up.commands.flight_state_command import FlightStateCommand, FlyByWireLimitsCommand
from up.commands.refusal import Code, CommandRefusedError

NAME = "airframe.yml"
TRIM = "rudder: {trim_us: 20}\n"
ROLL = "fly_by_wire: {roll_deg: 33.333}\n"
PROFILE_INVALID = 1 << 6


def wire(**changes):
    """Return the 54 bytes of a new Arduino's profile with some places changed."""
    values = list(PROFILE)
    for place, value in changes.items():
        values[int(place.removeprefix("at"))] = value
    return struct.pack(PROFILE_FORMAT, *values)


TRIMMED = wire(at13=20)


def refusal(outcome):
    assert isinstance(outcome[0], CommandRefusedError)
    return outcome[0]


@pytest.fixture
def framed(make_rig):
    def make(text=TRIM, framing="checked", **config):
        return make_rig(framing, {NAME: text, **config}, modules=[Ground])

    return make


@pytest.fixture
def logged():
    """The log events of the module."""
    lines = []

    def observe(event):
        if event["log_namespace"] == "ArduinoProfile":
            lines.append(event)

    globalLogPublisher.addObserver(observe)
    yield lines
    globalLogPublisher.removeObserver(observe)


@pytest.mark.parametrize("text", [None, "", "rudder: {trim_us: null}\n"])
def test_without_a_word_the_profile_is_read_and_nothing_pushed_or_forbidden(make_rig, text):
    rig = make_rig("checked", {} if text is None else {NAME: text})
    rig.connect()
    rig.alive(3)
    assert (rig.sent("c"), rig.sent("C")) == ([b""], [])
    assert rig.up.vetoes.own == {} and rig.arduino.has_motor is True


def test_its_limits_of_fbw_are_told_before_the_board_says_who_flies(framed):
    rig = framed("fly_by_wire: {roll_deg: 33.333, pitch_down_deg: 10}\n")
    told = []
    for kind in (FlyByWireLimitsCommand, FlightStateCommand):
        rig.up.command_executor.register_command(kind, told.append)
    rig.connect(armed=True)
    assert told[0] == FlyByWireLimitsCommand(33.333, None, 10.0)
    assert isinstance(told[1], FlightStateCommand)


def test_a_disarmed_board_that_differs_gets_it_once_and_is_read_back(framed, logged):
    rig = framed()
    rig.connect(armed=False)
    rig.alive(5)
    assert rig.sent("C") == [TRIMMED]
    assert rig.sent("c") == [b"", b""]
    assert rig.up.vetoes.own == {}
    (sent,) = (each for each in logged if each["code"] == "profile_sent")
    assert sent["text"] == "rudder.trim_us 0, wanted 20"


def test_a_board_that_does_not_differ_is_left_alone(framed):
    rig = framed()
    rig.profile = TRIMMED
    rig.connect(armed=True)
    rig.alive(5)
    assert rig.sent("c") == [b""]
    assert rig.sent("C") == []
    assert rig.up.vetoes.own == {}


def test_other_values_of_the_board_stay(framed):
    rig = framed()
    rig.profile = wire(at1=-55, at16=2)
    rig.connect(armed=False)
    rig.alive(1)
    assert rig.profile == wire(at1=-55, at16=2, at13=20)


def test_an_angle_is_taken_as_the_wire_rounds_it(framed):
    rig = framed(ROLL)
    rig.connect(armed=False)
    rig.alive(5)
    assert rig.sent("C") == [wire(at19=3333)]
    assert rig.up.vetoes.own == {}


def test_an_armed_board_gets_nothing_and_arming_stays_forbidden(framed, logged):
    rig = framed()
    rig.connect(armed=True)
    rig.alive(3)
    assert rig.sent("C") == []
    assert "rudder.trim_us 0, wanted 20" in rig.up.vetoes.own[NAME]
    assert rig.sent("v")[-1] == b"\1"
    assert [each["code"] for each in logged] == ["profile_differs_in_flight"]
    rig.alive(1, armed=False)
    assert rig.sent("C") == [TRIMMED]
    assert rig.sent("v")[-1] == b"\0"


def test_nothing_is_pushed_before_the_board_said_that_it_is_disarmed(framed):
    rig = framed()
    rig.start()
    rig.say("O", b"\0" * 26)
    rig.advance(0.9)
    assert rig.sent("c") != []
    assert rig.sent("C") == []
    assert NAME in rig.up.vetoes.own
    rig.status(armed=False)
    assert rig.sent("C") == [TRIMMED]


def test_arming_is_forbidden_from_the_first_moment_until_it_is_compared(framed):
    rig = framed()
    rig.mute = {"c"}
    rig.connect(armed=False)
    refused = refusal(rig.ask(ArmCommand()))
    assert refused.detail == "veto" and NAME in refused.reason
    with capturedLogs() as events:
        rig.alive(1.4)
    assert "no_answer" in [each.get("detail") for each in events]
    assert NAME in rig.up.vetoes.own
    rig.mute = set()
    rig.profile = TRIMMED
    rig.alive(3)
    assert rig.ask(ArmCommand()) == ["done"]


def test_a_refused_profile_is_tried_again_ever_more_seldom(framed):
    rig = framed()
    rig.refuse = {"C": 3}
    rig.connect(armed=False)
    counts = []
    for _ in range(6):
        rig.forget()
        rig.alive(20)
        counts.append(len(rig.sent("C")))
    assert counts[0] >= 3
    assert sum(counts[3:]) <= 2
    assert REASONS[Reason.OUT_OF_RANGE] in rig.up.vetoes.own[NAME]
    rig.refuse = {}
    rig.alive(61)
    assert rig.profile == TRIMMED
    assert rig.up.vetoes.own == {}


def test_a_board_that_holds_another_one_afterwards_is_not_believed(framed):
    rig = framed()
    answer = rig.on_command

    def forgetful(command):
        answer(command)
        rig.profile = wire()

    rig.on_command = forgetful
    with capturedLogs() as events:
        rig.connect(armed=False)
        rig.alive(0.6)
    assert "value_differs" in [each.get("detail") for each in events]
    assert NAME in rig.up.vetoes.own


def test_a_lost_confirmation_is_no_reason_to_write_again(framed):
    rig = framed()
    answer = rig.on_command

    def mute_but_good(command):
        if not isinstance(command, int) and command.type == "C":
            rig.profile = command.payload
            return
        answer(command)

    rig.on_command = mute_but_good
    rig.connect(armed=False)
    rig.alive(5)
    # The requests itself repeats once; after that the board's values are requested first.
    assert len(rig.sent("C")) == 2
    assert rig.up.vetoes.own == {}


def test_a_reset_board_is_compared_anew(framed):
    rig = framed()
    rig.connect(armed=False)
    rig.alive(1)
    rig.status(uptime_s=100)
    rig.forget()
    rig.profile = wire()
    rig.status(uptime_s=0, cause=1)
    rig.alive(1)
    assert rig.sent("C") == [TRIMMED]


def test_a_damaged_copy_in_the_board_is_written_anew(framed):
    rig = framed()
    rig.profile = TRIMMED
    rig.connect(armed=False)
    rig.alive(1, vetoes=PROFILE_INVALID)
    rig.alive(1, vetoes=0)
    assert rig.sent("C") == [TRIMMED]
    assert rig.up.vetoes.own == {}


def test_end_points_that_do_not_fit_the_boards_are_told_and_never_sent(framed, logged):
    rig = framed("rudder: {lowest_us: 2100}\n")
    rig.connect(armed=False)
    rig.alive(5)
    assert rig.sent("C") == []
    assert "rudder.highest_us" in rig.up.vetoes.own[NAME]
    assert [each["code"] for each in logged] == ["profile_invalid"]


def test_a_profile_that_cannot_be_is_not_believed(framed):
    rig = framed()
    rig.profile = wire(at16=9)
    rig.connect(armed=False)
    rig.alive(1)
    assert "mix: 9" in rig.up.vetoes.own[NAME]
    assert rig.sent("C") == []


def test_an_old_firmware_gets_nothing_and_it_is_said_once(framed, logged):
    rig = framed(framing="thesis")
    rig.start()
    rig.throttle(1000)
    rig.advance(3)
    assert b"C" not in {bytes([each]) for each in rig.port.heard if isinstance(each, int)}
    assert rig.sent("cC") == []
    assert [each["code"] for each in logged] == ["profile_not_supported"]
    assert NAME not in rig.up.vetoes.own
    assert refusal(rig.ask(ArduinoProfileRequestCommand())).detail == "old_firmware"


def test_a_request_is_answered_with_what_the_board_holds(framed):
    rig = framed("")
    rig.profile = TRIMMED
    rig.connect(armed=True)
    assert rig.ask(ArduinoProfileRequestCommand()) == ["done"]
    (message,) = rig.module(Ground).sent
    assert message.name == "arduino.profile.values"
    assert message.data["rudder"] == {
        "reversed": False, "trim_us": 20, "lowest_us": 1000, "highest_us": 2000
    }  # fmt: skip
    assert message.data["switch"] == {"low": "ACRO", "middle": "FBW", "high": "AUTO"}
    assert message.data["receiver_lost"]["glide_pitch_deg"] == -3.0


def test_a_request_without_a_ground_or_an_arduino_is_refused(framed):
    rig = framed("")
    rig.start_alone()
    assert refusal(rig.ask(ArduinoProfileRequestCommand())).code is Code.UNAVAILABLE
    rig.status()
    rig.module(Ground).is_there = False
    assert refusal(rig.ask(ArduinoProfileRequestCommand())).code is Code.UNAVAILABLE
