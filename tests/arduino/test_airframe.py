"""The profile on the compiled firmware: mixes, directions, trims, ends, motor, limits."""

import pytest

from tests.arduino.commands import SERVOS, profile
from tests.arduino.flight import LOW, MIDDLE, Flight
from up.commands.board_schema import Reason

A_DEGREE_US = 20
"""What the default gains make of a degree."""


@pytest.fixture
def flight(shared):
    """Return a disarmed aircraft in ACRO, level, sticks centred."""
    shared.sticks(ailerons=1500, elevator=1500, throttle=LOW, rudder=1500, aux1=LOW, aux2=LOW)
    return shared


def fit(flight, servos=None, **changes):
    assert flight.ask("C", profile(servos, **changes)) == "K"


def servos_us(flight):
    flight.servo_us("ailerons")
    return [flight.rig.servo.newest_us(each) for each in SERVOS]


def test_sticks_pass_straight_through(flight):
    fit(flight)
    flight.sticks(ailerons=1234, elevator=1678, rudder=1890)
    assert servos_us(flight) == pytest.approx([1234, 1678, 1000, 1890], abs=1)


def test_stabilisation_passes_the_mix_and_the_directions(flight):
    fit(flight, {"ailerons": {"reversed": 1}}, mix=1)
    flight.sticks(aux1=MIDDLE)
    flight.tilt(20)
    # To level, the right elevon goes one way and the left the other; the first one is reversed.
    left, right, *_ = servos_us(flight)
    assert left < 1400 and right < 1400
    flight.tilt(0)


def test_a_glider_takes_no_other_settings_once_its_receiver_was_heard():
    """Without a motor it flies disarmed: only a silent transmitter proves the ground."""
    flight = Flight()
    fit(flight, motor=0)
    assert flight.ask("C", profile(motor=0)) == Reason.ONLY_ON_GROUND
    assert flight.ask("e", b"\0") == Reason.ONLY_ON_GROUND
    assert flight.ask("e", b"\3") == Reason.ONLY_ON_GROUND
    flight.run_ms(700)
    still = Flight(receiver=False, eeprom=flight.rig.eeprom.read())
    assert still.ask("C", profile(motor=0)) == Reason.ONLY_ON_GROUND
    still.run_ms(5000)
    assert still.ask("e", b"\0") == "K"
    assert still.ask("C", profile(motor=0)) == "K"
    still.rig.receiver.start()
    still.run_ms(200)
    assert still.ask("C", profile(motor=0)) == Reason.ONLY_ON_GROUND


def test_a_profile_is_kept_over_a_power_cycle(flight):
    fit(flight, {"rudder": {"reversed": 1, "trim_us": 40}}, mix=1)
    flight.run_ms(700)
    again = Flight(eeprom=flight.rig.eeprom.read())
    again.sticks(ailerons=1600, rudder=1700)
    assert servos_us(again) == pytest.approx([1400, 1600, 1000, 1340], abs=1)
