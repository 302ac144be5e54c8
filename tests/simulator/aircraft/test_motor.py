"""Motor, propeller and battery: figures of a 150 to 200 W drive on three cells."""

import pytest

from up_simulator.aircraft import load_airframe
from up_simulator.aircraft.airframe_file import BatteryConfig, MotorConfig
from up_simulator.aircraft.motor import Battery, Motor, charge_at

STEP_S = 0.002
GLIDER = load_airframe("glider")


def drive(config=GLIDER.motor, **battery):
    values = {"cells": 3, "capacity_mah": 2200.0, **battery}
    made = Battery(BatteryConfig(**values))
    return Motor(config, made), made


def run(motor, throttle, seconds, airspeed_m_s=0.0):
    for _ in range(round(seconds / STEP_S)):
        motor.step(throttle, airspeed_m_s, STEP_S)


def test_full_power_on_the_ground():
    """A 9 x 6 at 1000 rpm/V: 8500 to 10500 rpm, 6 to 10 N, 150 to 230 W."""
    motor, battery = drive()
    run(motor, 1.0, 2.0)
    assert 8500 < motor.rpm < 10500
    assert 6.0 < motor.thrust_n < 11.0
    assert 150 < motor.power_w < 230
    assert battery.current_a == pytest.approx(motor.power_w / battery.voltage_v, abs=0.3)


def test_it_takes_a_moment_to_spin_up_and_brakes_when_off():
    motor, _ = drive()
    run(motor, 1.0, 0.05)
    early = motor.rpm
    run(motor, 1.0, 1.0)
    assert 0.3 < early / motor.rpm < 0.95
    run(motor, 0.0, 2.0, airspeed_m_s=12.0)
    assert (motor.rpm, motor.thrust_n, motor.power_w) == (0.0, 0.0, 0.0)


def test_thrust_falls_with_the_airspeed_and_rises_with_the_throttle():
    def thrust(throttle, airspeed_m_s):
        motor, _ = drive()
        run(motor, throttle, 1.0, airspeed_m_s)
        return motor.thrust_n

    assert thrust(1.0, 0.0) > thrust(1.0, 10.0) > thrust(1.0, 20.0) > 0.0
    forces = [thrust(part / 10, 8.0) for part in range(3, 11)]
    assert forces == sorted(forces)
    # Diving with a little throttle the propeller brakes, but not without bounds.
    assert -3.0 < thrust(0.1, 25.0) < 0.0


def test_the_battery_sags_under_load_and_recovers():
    motor, battery = drive()
    rested = battery.voltage_v
    run(motor, 1.0, 3.0)
    loaded = battery.voltage_v
    run(motor, 0.0, 3.0)
    assert rested == pytest.approx(12.54)
    assert 11.5 < loaded < 12.3
    assert loaded < battery.voltage_v < rested


def test_full_power_lasts_as_long_as_the_battery_and_then_ends():
    """2.2 Ah at about 15 A: 8 to 10 minutes."""
    motor, battery = drive()
    seconds = 0
    while motor.rpm > 1000 or not seconds:
        run(motor, 1.0, 10.0)
        seconds += 10
        assert seconds < 900
    assert 420 < seconds < 700
    assert battery.open_v == pytest.approx(9.6)
    assert battery.percent == 0.0
    run(motor, 1.0, 2.0)
    assert (motor.rpm, motor.thrust_n) == (0.0, 0.0)


@pytest.mark.parametrize("percent", [100.0, 80.0, 50.0, 30.0, 10.0, 5.0, 1.0, 0.0])
def test_the_volts_of_a_cell_fall_with_its_charge(percent):
    _, battery = drive(charge_percent=percent)
    assert 3.2 <= battery.open_v / 3 <= 4.2
    _, fuller = drive(charge_percent=min(100.0, percent + 5))
    assert fuller.open_v >= battery.open_v


def test_spun_up_it_turns_as_it_does_after_a_while_and_nothing_was_drawn():
    ready, battery = drive()
    ready.spin_up(0.7, 11.0)
    late, _ = drive()
    run(late, 0.7, 3.0, 11.0)
    assert ready.rpm == pytest.approx(late.rpm, rel=0.03)
    assert battery.percent == 100.0


def test_extreme_motors_stay_finite():
    for kv, diameter, cells in ((100.0, 1.0, 1), (20000.0, 0.05, 14), (4000.0, 0.5, 6)):
        config = MotorConfig(kv_rpm_v=kv, diameter_m=diameter, resistance_ohm=0.05)
        motor, battery = drive(config, cells=cells)
        run(motor, 1.0, 1.0, 20.0)
        assert abs(motor.thrust_n) < 1e6
        assert 0.0 <= battery.voltage_v <= cells * 4.2


@pytest.mark.parametrize("percent", [0, 3, 5, 20, 55, 100])
def test_the_charge_at_a_voltage_is_the_one_that_gives_it(percent):
    _, battery = drive()
    battery.charge(percent)
    assert charge_at(battery.open_v / 3) == pytest.approx(percent)
    assert battery.percent == pytest.approx(percent)
