"""Commands of docs/protocols.md 2.3 on the compiled firmware; arduino/host tests their ranges."""

import struct

import pytest

from tests.arduino.commands import outputs
from tests.arduino.flight import HIGH, LOW, Flight
from up_rig.imu import motion_at


@pytest.fixture
def auto(flight):
    """Return an armed aircraft with the switch at AUTO, forwarding."""
    flight.run_ms(1500)
    flight.arm()
    flight.sticks(aux1=HIGH)
    flight.send("s")
    flight.run_ms(50)
    return flight


def test_inputs_and_outputs_are_reported_as_measured(flight):
    flight.sticks(ailerons=1200, elevator=1700, rudder=1650, throttle=1300, aux1=LOW)
    flight.send("s")
    *inputs_us, valid = struct.unpack(">6HB", flight.newest("i").payload)
    assert inputs_us == pytest.approx([1200, 1700, 1300, 1650, 1000, 1000], abs=1)
    assert valid == 0x3F
    outputs_us = struct.unpack(">4H", flight.newest("r").payload)
    assert outputs_us == pytest.approx((1200, 1700, 1000, 1650), abs=1)
    assert flight.servo_us("ailerons") == pytest.approx(1200, abs=1)


def test_outputs_reach_the_servos_while_they_are_fresh(auto):
    assert auto.ask("M", b"u") == "K"
    auto.send("u", outputs(auto, 1234, 1765, 1450, 1610))
    auto.rig.servo.clear()
    auto.run_ms(60)
    widths = [auto.rig.servo.newest_us(each) for each in ("ailerons", "elevator", "rudder")]
    assert widths == pytest.approx([1234, 1765, 1610], abs=0.6)
    assert auto.rig.servo.newest_us("throttle") == pytest.approx(1450, abs=0.6)
    auto.run_ms(200)
    assert auto.servo_us("ailerons") == pytest.approx(1500, abs=5)
    assert auto.servo_us("throttle") == pytest.approx(1000, abs=1)
    auto.run_ms(200)
    assert auto.mode() == "f"


def test_level_is_the_calibrated_attitude(flight):
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
