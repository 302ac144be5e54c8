"""Arming: its conditions, its effects, and what never arms."""

import math

import pytest

from tests.arduino.commands import outputs, profile
from tests.arduino.flight import HIGH, IMU, LOW, MIDDLE, RECEIVER, Flight
from up_rig.imu import motion_at

THROTTLE_NOT_LOW, RECEIVER_INVALID, IMU_INVALID, VETO = 8, 9, 10, 11
CALIBRATING = 32


@pytest.fixture(scope="module")
def shared():
    flight = Flight()
    flight.run_ms(1500)
    return flight


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


def test_an_aux2_that_went_high_while_the_receiver_was_lost_arms_nothing(calm):
    calm.rig.receiver.stop()
    calm.run_ms(400)
    calm.rig.receiver.sticks(aux2=HIGH)
    calm.rig.receiver.start()
    calm.run_ms(1000)
    status = calm.status()
    assert not status.vetoes
    assert not status.is_armed


def test_the_edge_is_debounced_for_300_ms(calm):
    calm.sticks(260, aux2=HIGH)
    calm.sticks(500, aux2=LOW)
    assert not calm.status().is_armed
    # A low that is too short does not count: the following high is not an edge.
    calm.sticks(500, throttle=1200, aux2=HIGH)
    calm.sticks(100, throttle=LOW)
    calm.sticks(200, aux2=LOW)
    calm.sticks(500, aux2=HIGH)
    assert not calm.status().is_armed


def test_the_pilot_disarms_at_any_throttle(calm):
    calm.arm()
    calm.sticks(throttle=1800)
    calm.sticks(400, aux2=LOW)
    assert not calm.status().is_armed
    assert calm.servo_us("throttle") == pytest.approx(1000, abs=1)


def test_disarmed_the_motor_stands_whatever_the_stick_does(calm):
    calm.rig.servo.forget()
    for throttle in (1100, 1500, 2000, 1050):
        calm.sticks(60, throttle=throttle)
    widths = [each.width_us for each in calm.rig.servo.pulses("throttle")]
    assert len(widths) >= 10
    assert widths == pytest.approx([1000] * len(widths), abs=1)


def test_surfaces_and_stabilisation_work_disarmed(calm):
    calm.sticks(ailerons=1700)
    assert calm.servo_us("ailerons") == pytest.approx(1700, abs=1)
    calm.sticks(ailerons=1500, aux1=MIDDLE)
    calm.tilt(30)
    assert calm.servo_us("ailerons") < 1300
    calm.tilt(0)
    assert not calm.status().is_armed


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


def test_aux2_low_holds_off_the_command(calm):
    assert calm.status().vetoes & 8
    assert calm.ask("a") == VETO
    assert not calm.status().is_armed


def test_calibration_holds_off_arming():
    flight = Flight(boots=False)
    # Never still: the gyro's bias is looked for until 10 s have passed.
    flight.rig.imu.noise_deg_s = 12.0
    flight.run_ms(2000)
    flight.sticks(500, aux2=HIGH)
    status = flight.status()
    assert status.vetoes & 32
    assert not status.is_armed
    assert flight.ask("a") == VETO


def test_a_broken_profile_holds_off_arming(calm):
    assert calm.ask("C", profile()) == "K"
    calm.run_ms(700)
    kept = bytearray(calm.rig.eeprom.read())
    blank = Flight().rig.eeprom.read()
    for at, (here, there) in enumerate(zip(kept, blank, strict=True)):
        if here != there:
            kept[at] ^= 0x40
    flight = Flight(eeprom=bytes(kept))
    flight.run_ms(1500)
    flight.sticks(500, aux2=HIGH)
    status = flight.status()
    assert status.vetoes & 64
    assert not status.is_armed
    # It flies nevertheless, by the profile of the first boot.
    assert flight.servo_us("ailerons") == pytest.approx(1500, abs=1)


def test_losing_imu_or_receiver_never_disarms(calm):
    calm.arm()
    calm.rig.imu.unplug()
    calm.run_ms(700)
    status = calm.status()
    assert status.is_armed and not status.flags & IMU
    calm.rig.receiver.stop()
    calm.run_ms(1500)
    status = calm.status()
    assert status.is_armed and not status.flags & RECEIVER
    calm.rig.imu.plug()
    calm.rig.receiver.start()
    calm.run_ms(1000)
    status = calm.status()
    assert status.is_armed and status.flags & IMU and status.flags & RECEIVER


def test_a_glider_needs_neither_low_throttle_nor_arming():
    flight = Flight()
    flight.run_ms(1500)
    assert flight.ask("C", profile(motor=0)) == "K"
    flight.sticks(throttle=1700)
    # An edge that an interrupt delays is believed to 6 us only.
    assert flight.servo_us("throttle") == pytest.approx(1700, abs=3)
    assert not flight.status().vetoes & 1
    flight.sticks(aux1=HIGH)
    flight.send("s")
    assert flight.ask("M", b"u") == "K"
    flight.send("u", outputs(flight, 1800))
    assert flight.servo_us("ailerons") == pytest.approx(1800, abs=1)
    assert not flight.status().is_armed
    flight.sticks(400, aux2=HIGH)
    assert flight.status().is_armed
    assert flight.ask("d") == "K"
    assert not flight.status().is_armed


def test_with_a_motor_auto_gives_no_authority_disarmed(calm):
    calm.sticks(aux1=HIGH)
    calm.send("s")
    assert calm.ask("M", b"u") == "K"
    calm.send("u", outputs(calm, 1800, throttle=1800))
    assert calm.servo_us("ailerons") == pytest.approx(1500, abs=5)
    assert calm.servo_us("throttle") == pytest.approx(1000, abs=1)
