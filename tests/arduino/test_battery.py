"""The flight battery on pin A7 of the compiled firmware: from the pin's voltage to the status."""

import itertools

import pytest

from tests.arduino.flight import Flight
from up.commands.board_schema import Reason

A7 = 7
DIVIDER = 1.5 / (22 + 1.5)
SETTLED_MS = 7_000


def wired(voltage_v, **options):
    flight = Flight(boots=False, **options)
    flight.rig.set_analog(A7, voltage_v * DIVIDER)
    flight.run_ms(2900)
    return flight


def calibrate(flight, voltage_v):
    return flight.ask("V", round(voltage_v * 1000).to_bytes(2, "big"))


def voltage_v(flight):
    return flight.status().battery_mv / 1000


def test_the_voltage_of_the_pin_is_in_the_status_and_its_scale_survives_every_reset():
    flight = wired(12.34)
    assert voltage_v(flight) == 0
    assert calibrate(flight, 12.34) == "K"
    assert voltage_v(flight) == pytest.approx(12.34, abs=0.02)
    flight.rig.set_analog(A7, 10.5 * DIVIDER)
    flight.run_ms(SETTLED_MS)
    assert voltage_v(flight) == pytest.approx(10.5, abs=0.03)
    flight.may_be_cut = True
    flight.rig.press_reset()
    flight.run_ms(1500)
    assert voltage_v(flight) == pytest.approx(10.5, abs=0.03)
    again = wired(11.1, eeprom=flight.rig.eeprom.read())
    assert voltage_v(again) == pytest.approx(11.1, abs=0.03)


def test_a_pin_beyond_1_1_volt_is_unknown_and_a_pin_at_ground_is_not_calibrated():
    flight = wired(12.34)
    assert calibrate(flight, 12.34) == "K"
    flight.rig.set_analog(A7, 1.2)
    flight.run_ms(100)
    assert voltage_v(flight) == 0
    assert calibrate(flight, 12.34) == Reason.BATTERY_NOT_MEASURED
    assert calibrate(wired(0.0), 12.34) == Reason.BATTERY_NOT_MEASURED


def test_the_conversions_cost_no_slot_its_time_and_an_armed_board_is_not_calibrated():
    flight = wired(12.34)
    flight.arm()
    flight.rig.servo.clear()
    flight.run_ms(1000)
    assert calibrate(flight, 12.34) == Reason.ONLY_ON_GROUND
    status = flight.status()
    assert abs(status.loop_us - 2000) <= 1
    assert status.late_us < 200
    rises = [each.rise_cycle for each in flight.rig.servo.pulses("ailerons")]
    assert len(rises) > 40
    assert all(abs(b - a - 320_000) < 160 for a, b in itertools.pairwise(rises))
