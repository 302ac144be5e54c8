"""Arming: its conditions, its effects, and what never arms."""

import math

import pytest

from tests.arduino.flight import HIGH, IMU, LOW, Flight
from up_rig.imu import motion_at

THROTTLE_NOT_LOW, RECEIVER_INVALID, IMU_INVALID, VETO = 8, 9, 10, 11
CALIBRATING = 32


@pytest.fixture
def calm(shared):
    """Return a disarmed aircraft, throttle low, AUX2 low."""
    shared.rig.imu.plug()
    shared.rig.receiver.start()
    shared.send("v", b"\0")
    shared.sticks(500, ailerons=1500, throttle=LOW, aux1=LOW, aux2=LOW)
    status = shared.status()
    if not status.flags & IMU:
        shared.run_ms(700)
    assert not status.is_armed
    return shared


@pytest.mark.parametrize("receiver_after_ms", [0, 2500])
def test_an_aux2_that_is_high_at_power_on_arms_nothing(receiver_after_ms):
    """Neither does that of a receiver switched on when no other veto is left."""
    flight = Flight(boots=False, receiver=False)
    flight.run_ms(receiver_after_ms)
    flight.rig.receiver.sticks(aux2=HIGH)
    flight.rig.receiver.start()
    flight.run_ms(3000)
    status = flight.status()
    assert not status.vetoes
    assert not status.is_armed
    flight.sticks(500, aux2=LOW)
    flight.sticks(400, aux2=HIGH)
    assert flight.status().is_armed


def test_without_any_bias_nothing_arms_until_the_aircraft_was_still():
    """Moved from power-on for longer than arming waits, with a blank EEPROM."""
    flight = Flight(boots=False)
    flight.rig.imu.bias_deg_s = (2.0, -3.0, 1.0)
    flight.rig.imu.motion = lambda time_s: motion_at(
        5 * math.sin(6 * time_s), 0, (30 * math.cos(6 * time_s), 0, 0)
    )
    flight.run_ms(12_500)
    flight.sticks(400, aux2=HIGH)
    status = flight.status()
    assert not status.is_armed
    assert status.vetoes & CALIBRATING
    assert flight.ask("a") == VETO
    flight.rig.imu.motion = motion_at(0, 0)
    flight.run_ms(2500)
    assert not flight.status().vetoes & CALIBRATING
    flight.sticks(400, aux2=LOW)
    flight.sticks(400, aux2=HIGH)
    assert flight.status().is_armed


def test_disarmed_the_motor_stands_whatever_the_stick_does(calm):
    calm.rig.servo.clear()
    for throttle in (1100, 1500, 2000, 1050):
        calm.sticks(60, throttle=throttle)
    widths = calm.widths_us("throttle")
    assert len(widths) >= 10
    assert widths == pytest.approx([1000] * len(widths), abs=1)


def raise_throttle(flight):
    flight.sticks(throttle=1200)


def lose_receiver(flight):
    flight.rig.receiver.stop("rudder")
    flight.run_ms(150)


def lose_imu(flight):
    flight.rig.imu.unplug()
    flight.run_ms(150)


def veto(flight):
    flight.send("v", b"\1")


@pytest.mark.parametrize(
    ("against", "bit", "reason"),
    [
        (raise_throttle, 1, THROTTLE_NOT_LOW),
        (lose_receiver, 2, RECEIVER_INVALID),
        (lose_imu, 4, IMU_INVALID),
        (veto, 16, VETO),
    ],
)
def test_what_speaks_against_arming_holds_off_switch_and_command(calm, against, bit, reason):
    against(calm)
    calm.sticks(400, aux2=HIGH)
    status = calm.status()
    assert status.vetoes & bit
    assert not status.is_armed
    against(calm)
    assert calm.ask("a") == reason
    # A missed edge is not made up for: the switch must move again.
    calm.rig.imu.plug()
    calm.rig.receiver.start()
    calm.sticks(1300, throttle=LOW)
    assert not calm.status().vetoes
    assert not calm.status().is_armed
