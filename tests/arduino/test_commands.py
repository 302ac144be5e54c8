"""Commands of docs/protocols.md 2.3 on the compiled firmware; arduino/host tests their ranges."""

import struct

import pytest

from tests.arduino.flight import GAINS_KEPT, HIGH, LOW, Flight
from up.commands.board_schema import Reason
from up_rig.imu import motion_at

GAINS = tuple(0.25 * each for each in range(1, 19))


def gains(*values):
    return struct.pack(f">{len(values)}f", *values)


def outputs(flight, ailerons=1500, elevator=1500, throttle=0, rudder=1500, sequence=None):
    if sequence is None:
        sequence = flight.orientation_sequence()
    return struct.pack(">5H", ailerons, elevator, throttle, rudder, sequence)


def setpoint(roll=0, pitch=0, yaw_rate=0, throttle=0, lifetime_ms=250):
    return struct.pack(">3h2H", roll, pitch, yaw_rate, throttle, lifetime_ms)


@pytest.fixture
def auto(flight):
    """Return an armed aircraft with the switch at AUTO, forwarding."""
    flight.run_ms(1500)
    flight.arm()
    flight.sticks(aux1=HIGH)
    flight.send("s")
    flight.run_ms(50)
    return flight


def test_start_begins_the_streams_and_nothing_streams_before(flight):
    flight.run_ms(500)
    assert flight.messages == []
    assert flight.ask("s") == "K"
    flight.run_ms(1000)
    counts = {letter: sum(each.type == letter for each in flight.messages) for letter in "irOxo"}
    assert 48 <= counts["i"] <= 53
    assert 48 <= counts["r"] <= 53
    assert 48 <= counts["O"] <= 53
    assert 5 <= counts["x"] <= 6
    assert counts["o"] == 0


def test_inputs_and_outputs_are_told_as_they_are(flight):
    flight.sticks(ailerons=1200, elevator=1700, rudder=1650, throttle=1300, aux1=LOW)
    flight.send("s")
    *inputs_us, valid = struct.unpack(">6HB", flight.newest("i").payload)
    assert inputs_us == pytest.approx([1200, 1700, 1300, 1650, 1000, 1000], abs=1)
    assert valid == 0x3F
    outputs_us = struct.unpack(">4H", flight.newest("r").payload)
    assert outputs_us == pytest.approx((1200, 1700, 1000, 1650), abs=1)
    assert flight.servo_us("ailerons") == pytest.approx(1200, abs=1)


def test_arm_and_disarm(flight):
    flight.run_ms(1500)
    assert flight.ask("a") == Reason.VETO
    flight.sticks(400, aux2=HIGH)
    if flight.status().is_armed:
        flight.sticks(2200)
        assert flight.ask("d") == "K"
        assert not flight.status().is_armed
    assert flight.ask("a") == "K"
    assert flight.status().is_armed


def test_gains_taken_disarmed_are_kept_and_those_of_a_flight_are_not(flight):
    flight.run_ms(1500)
    assert not flight.status().flags & GAINS_KEPT
    assert flight.ask("g", gains(*GAINS)) == "K"
    flight.run_ms(600)
    assert flight.status().flags & GAINS_KEPT
    flight.arm()
    assert flight.ask("g", gains(*reversed(GAINS))) == "K"
    assert flight.ask("G") == gains(*reversed(GAINS))
    flight.run_ms(600)
    again = Flight(eeprom=flight.rig.eeprom.read())
    assert again.ask("G") == gains(*GAINS)


def test_outputs_reach_the_servos_while_they_are_fresh(auto):
    assert auto.ask("M", b"u") == "K"
    auto.send("u", outputs(auto, 1234, 1765, 1450, 1610))
    auto.rig.servo.forget()
    auto.run_ms(60)
    widths = [auto.rig.servo.newest_us(each) for each in ("ailerons", "elevator", "rudder")]
    assert widths == pytest.approx([1234, 1765, 1610], abs=0.6)
    assert auto.rig.servo.newest_us("throttle") == pytest.approx(1450, abs=0.6)
    auto.run_ms(200)
    assert auto.servo_us("ailerons") == pytest.approx(1500, abs=5)
    assert auto.servo_us("throttle") == pytest.approx(1000, abs=1)
    auto.run_ms(200)
    assert auto.mode() == "f"


def test_an_output_leaves_nothing_of_an_older_setpoint(auto):
    auto.send("S", setpoint(throttle=1200))
    auto.run_ms(30)
    auto.send("u", outputs(auto, 1900, 1900, 1100, 1900))
    auto.run_ms(30)
    assert auto.ask("M", b"s") == "K"
    auto.rig.servo.forget()
    auto.run_ms(150)
    for channel, most_us in (("throttle", 1001), ("ailerons", 1520), ("rudder", 1520)):
        assert max(each.width_us for each in auto.rig.servo.pulses(channel)[1:]) <= most_us


def test_the_profile_is_taken_told_and_kept(flight):
    profile = bytearray(flight.ask("c"))
    assert len(profile) == 54
    profile[30:33] = b"ffA"
    assert flight.ask("C", bytes(profile)) == "K"
    assert flight.ask("c") == bytes(profile)
    assert flight.mode() == "f"
    flight.run_ms(600)
    assert Flight(eeprom=flight.rig.eeprom.read()).ask("c") == bytes(profile)


def test_profile_and_calibration_wait_for_the_disarmed_aircraft(auto):
    assert auto.ask("C", auto.ask("c")) == Reason.ONLY_ON_GROUND
    for what in range(4):
        assert auto.ask("e", bytes((what,))) == Reason.ONLY_ON_GROUND


def test_level_is_what_it_is_told_to_be(flight):
    flight.run_ms(1500)
    flight.tilt(5, -4)
    flight.run_ms(2500)
    assert flight.ask("e", b"\0") == "K"
    assert flight.attitude()[:2] == pytest.approx((0, 0), abs=0.5)
    flight.run_ms(600)
    again = Flight(eeprom=flight.rig.eeprom.read(), boots=False)
    again.rig.imu.motion = motion_at(5, -4)
    again.run_ms(2500)
    assert again.attitude()[:2] == pytest.approx((0, 0), abs=0.7)


def test_the_gyros_bias_wants_stillness(flight):
    flight.rig.imu.bias_deg_s = (2.0, -1.0, 0.5)
    flight.run_ms(2500)
    assert flight.ask("e", b"\3") == "K"
    assert flight.attitude()[3:] == pytest.approx((0, 0, 0), abs=0.3)
    flight.tilt(30, seconds=0.3)
    assert flight.ask("e", b"\3") == Reason.NOT_STILL


def test_a_receiver_with_other_end_points_is_learned(flight):
    flight.run_ms(1500)
    assert flight.ask("e", b"\2") == Reason.OUT_OF_RANGE
    assert flight.ask("e", b"\1") == "K"
    names = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
    for end in (1100, 1900, 1500):
        flight.sticks(100, **dict.fromkeys(names, end))
    assert flight.ask("e", b"\2") == "K"
    flight.sticks(100, ailerons=1900, elevator=1100, aux1=1100)
    assert flight.servo_us("ailerons") == pytest.approx(2000, abs=3)
    assert flight.servo_us("elevator") == pytest.approx(1000, abs=3)
