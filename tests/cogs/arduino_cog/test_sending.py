"""Outputs, setpoints, location, altitude and headings on their way to the Arduino."""

import struct

import pytest

from up.commands.altitude_command import AltitudeCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.roles import Role

PHONE = Origin("android", Role.SENSOR, 5)
OTHER = Origin("other", Role.SENSOR, 1)
SILENCE_S = 1.1


def test_an_output_carries_the_sequence_of_its_orientation(rig):
    rig.connect()
    rig.publish(OutputCommand(1500, 1423, 0, 1600, 513))
    assert rig.sent("u") == [bytes.fromhex("05dc058f000006400201")]


def test_a_setpoint_is_sent_in_hundredths(rig):
    rig.connect()
    rig.publish(SetpointCommand(-30.0, 10.5, 0.0, 1600, 250))
    rig.publish(SetpointCommand(0.0, 0.0))
    assert rig.sent("S") == [
        bytes.fromhex("f448041a0000064000fa"),
        struct.pack(">3h2H", 0, 0, 0, 0, 250),
    ]


def test_a_setpoint_marked_as_failsafe_is_a_return_setpoint(rig):
    rig.connect()
    rig.publish(SetpointCommand(15.0, -2.5, 1.0, 1550, 200, is_failsafe=True))
    assert rig.sent("R") == [struct.pack(">3h2H", 1500, -250, 100, 1550, 200)]
    assert rig.sent("S") == []


def test_neither_is_ever_sent_in_thesis_framing(make_rig):
    rig = make_rig("thesis")
    rig.start()
    rig.say("o", b"\0" * 12)
    rig.forget()
    rig.publish(OutputCommand(1500, 1423, 0, 1600, 513))
    rig.publish(SetpointCommand(-30.0, 10.5))
    rig.advance(0.5)
    assert rig.port.heard == []


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("bad", [float("nan"), float("inf"), 1e9])
def test_a_setpoint_that_cannot_be_is_not_sent(rig, bad):
    rig.connect()
    rig.publish(SetpointCommand(bad, 0.0))
    assert rig.sent("S") == []
    assert rig.up.command_executor.counters["failed_handlers"] == 1


def test_outputs_that_nobody_reads_are_replaced_by_the_newest(rig):
    rig.connect()
    rig.forget()
    executor = rig.up.command_executor
    for number in range(5000):
        executor.execute_command(OutputCommand(1500, 1500, 0, 1500, number))
    rig.turn()
    sequences = [struct.unpack(">5H", each)[4] for each in rig.sent("u")]
    assert sequences[-1] == 4999
    assert sequences == sorted(sequences)
    assert len(sequences) < 5000, "the pty took them all: nothing waited, nothing is shown"


@pytest.mark.parametrize("framing", ["checked", "thesis"])
def test_where_the_aircraft_is_goes_to_the_thesis_firmware_which_has_a_use_for_it(
    make_rig, framing
):
    rig = make_rig(framing)
    rig.start()
    rig.say("r", b"\x05\xdc" * 4)
    rig.publish(LocationCommand(50.0, 14.5), origin=PHONE)
    rig.publish(AltitudeCommand(299.5), origin=PHONE)
    rig.publish(HeadingCommand(-45.0, "actual"), origin=PHONE)
    rig.publish(HeadingCommand(90.6, "required"), origin=PHONE)
    rig.advance(0.3)
    sent = [rig.sent(letter) for letter in "lhb"]
    places = [bytes.fromhex("4248000041680000")], [b"\x01\x2c"], [struct.pack(">h", 315)]
    assert sent == (list(places) if framing == "thesis" else [[], [], []])
    assert rig.sent("B") == [], "nothing flies to a heading"


@pytest.fixture
def old(make_rig):
    """A board with the thesis's firmware that answers."""
    rig = make_rig("thesis")
    rig.start()
    rig.throttle(1000)
    return rig


def test_only_what_the_provider_follows_is_forwarded(old):
    rig = old
    rig.publish(AltitudeCommand(100.0), origin=PHONE)
    rig.advance(0.2)
    rig.publish(AltitudeCommand(900.0), origin=OTHER)
    rig.publish(LocationCommand(50.0, 14.5), origin=PHONE)
    rig.publish(HeadingCommand(10.0, "actual"), origin=PHONE)
    rig.advance(0.2)
    rig.publish(LocationCommand(-50.0, 14.5), origin=OTHER)
    rig.publish(HeadingCommand(200.0, "actual"), origin=OTHER)
    rig.advance(0.2)
    assert rig.sent("h") == [struct.pack(">h", 100)]
    assert rig.sent("l") == [struct.pack(">2f", 50.0, 14.5)]
    assert rig.sent("b") == [struct.pack(">h", 10)]


def test_a_required_altitude_is_not_where_the_aircraft_is(old):
    rig = old
    rig.publish(AltitudeCommand(500.0, "required"), origin=PHONE)
    rig.advance(0.2)
    assert rig.sent("h") == []


def test_a_stream_of_fixes_is_sent_ten_times_a_second_and_only_on_change(old):
    rig = old
    for each in range(100):
        rig.publish(AltitudeCommand(each * 2.0), origin=PHONE)
        rig.advance(0.02)
    assert len(rig.sent("h")) <= 21
    rig.advance(0.2)
    rig.forget()
    for _ in range(20):
        rig.publish(AltitudeCommand(198.2), origin=PHONE)
        rig.advance(0.1)
    assert rig.sent("h") == []


def test_a_board_that_was_away_is_told_again(old):
    rig = old
    rig.publish(AltitudeCommand(100.0), origin=PHONE)
    rig.advance(SILENCE_S)
    assert not rig.arduino.connected
    rig.forget()
    rig.throttle(1000)
    rig.publish(AltitudeCommand(100.0), origin=PHONE)
    assert rig.sent("h") == [struct.pack(">h", 100)]


def test_a_source_that_is_not_followed_does_not_bring_an_old_reading_to_a_new_board(old):
    rig = old
    rig.publish(AltitudeCommand(100.0), origin=PHONE)
    rig.publish(LocationCommand(50.0, 14.5), origin=PHONE)
    rig.publish(HeadingCommand(10.0, "actual"), origin=PHONE)
    rig.advance(SILENCE_S)
    assert not rig.arduino.connected
    rig.forget()
    rig.throttle(1000)
    rig.publish(AltitudeCommand(900.0), origin=OTHER)
    rig.publish(LocationCommand(-50.0, 14.5), origin=OTHER)
    rig.publish(HeadingCommand(200.0, "actual"), origin=OTHER)
    rig.advance(0.2)
    assert rig.sent("hlb") == []
