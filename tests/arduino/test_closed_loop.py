"""The compiled firmware flies an aircraft: servo pulses in, the readings of an IMU on board out."""

import math

import pytest

from tests.arduino.flight import HIGH, LOW, MIDDLE, Flight
from up_rig.imu import GRAVITY_M_S2, Motion

STEP_S = 0.004
SPEED_M_S = 15.0
ROLL_RATE_DEG_S, PITCH_RATE_DEG_S = 180.0, 90.0
"""What full ailerons and elevator come to in the end."""
ROLL_LAG_S, PITCH_LAG_S = 0.12, 0.15


class Aircraft:
    """Roll and pitch of a small aircraft that turns without slipping, and banked sinks its nose.

    In such a turn the accelerometer shows the floor, not the ground: a controller that trusts it
    levels to a bank.
    """

    def __init__(self, roll_deg=0.0, pitch_deg=0.0):
        self.roll, self.pitch = math.radians(roll_deg), math.radians(pitch_deg)
        self.p = self.q = 0.0

    @property
    def roll_deg(self):
        return math.degrees(self.roll)

    @property
    def pitch_deg(self):
        return math.degrees(self.pitch)

    def step(self, ailerons_us, elevator_us):
        """Fly on for a step and return what its IMU feels."""
        wanted_p = math.radians(ROLL_RATE_DEG_S) * (ailerons_us - 1500) / 500
        wanted_q = math.radians(PITCH_RATE_DEG_S) * (elevator_us - 1500) / 500
        self.p += (wanted_p - self.p) * STEP_S / ROLL_LAG_S
        self.q += (wanted_q - self.q) * STEP_S / PITCH_LAG_S
        turn = GRAVITY_M_S2 * math.tan(max(-1.2, min(1.2, self.roll))) / SPEED_M_S
        r = turn * math.cos(self.roll) * math.cos(self.pitch)
        sine, cosine = math.sin(self.roll), math.cos(self.roll)
        self.roll += (self.p + math.tan(self.pitch) * (self.q * sine + r * cosine)) * STEP_S
        self.pitch += (self.q * cosine - r * sine) * STEP_S
        self.pitch = max(-1.4, min(1.4, self.pitch))
        load = 1 / max(0.3, cosine)
        return Motion(
            *(math.degrees(each) for each in (self.p, self.q, r)),
            GRAVITY_M_S2 * math.sin(self.pitch),
            0.0,
            -GRAVITY_M_S2 * load * math.cos(self.pitch),
        )


def fly(flight, aircraft, seconds, watch=None):
    """Fly in closed loop; ``watch`` is called with the time at each step."""
    widths = {"ailerons": 1500.0, "elevator": 1500.0}
    for at in range(round(seconds / STEP_S)):
        for channel in widths:
            newest = flight.rig.servo.newest_us(channel)
            widths[channel] = widths[channel] if newest is None else newest
        flight.rig.servo.clear()
        flight.rig.imu.motion = aircraft.step(*widths.values())
        flight.run(STEP_S * 1e6)
        if watch is not None:
            watch(at * STEP_S)


def banked(roll_deg, pitch_deg, **options):
    """Return a flight at an attitude, in ACRO so that it is not levelled in between."""
    flight = Flight(**options)
    flight.run_ms(1500)
    flight.tilt(roll_deg, pitch_deg, seconds=0.4)
    return flight, Aircraft(roll_deg, pitch_deg)


@pytest.mark.parametrize(("roll", "pitch"), [(60, 0), (-60, -20), (45, 15)])
def test_fbw_levels_the_aircraft(roll, pitch):
    flight, aircraft = banked(roll, pitch)
    flight.sticks(25, aux1=MIDDLE)
    times = []

    def watch(time_s):
        if abs(aircraft.roll_deg) > 5 or abs(aircraft.pitch_deg) > 5:
            times.append(time_s)

    fly(flight, aircraft, 3.5, watch)
    assert times[-1] < 2.0, "not level within 2 s"
    assert abs(aircraft.roll_deg) < 3
    assert abs(aircraft.pitch_deg) < 4


def test_acro_does_not():
    flight, aircraft = banked(40, 0)
    fly(flight, aircraft, 1.0)
    assert aircraft.roll_deg == pytest.approx(40, abs=3)


def test_with_nothing_but_arduino_and_imu_it_holds_level():
    flight = Flight(receiver=False)
    flight.run_ms(800)
    flight.tilt(35, -10, seconds=0.4)
    aircraft = Aircraft(35, -10)
    fly(flight, aircraft, 3.0)
    assert abs(aircraft.roll_deg) < 1
    assert abs(aircraft.pitch_deg) < 1
    assert flight.servo_us("throttle") == pytest.approx(1000, abs=1)


def test_a_lost_receiver_ends_in_the_circle_from_a_steep_bank():
    flight, aircraft = banked(-55, -15, aux1=LOW)
    flight.sticks(25, aux1=HIGH)
    flight.rig.receiver.stop()
    fly(flight, aircraft, 4.0)
    assert flight.status().is_failsafe
    assert aircraft.roll_deg == pytest.approx(20, abs=4)
    assert -8 < aircraft.pitch_deg < 1


def test_a_bank_that_the_stick_asks_for_is_held_though_the_accelerometer_feels_level():
    # At 20 degrees it feels 1.06 g, which alone would not give the turn away.
    flight, aircraft = banked(0, 0)
    flight.sticks(25, aux1=MIDDLE, ailerons=1700)
    worst = []

    def watch(time_s):
        if time_s > 2:
            worst.append(abs(aircraft.roll_deg - 20))

    fly(flight, aircraft, 30.0, watch)
    assert max(worst) < 1


def test_an_imu_lost_in_a_bank_leaves_the_pilot_the_surfaces_and_fbw_levels_when_it_is_back():
    flight, aircraft = banked(30, 0)
    flight.sticks(25, aux1=MIDDLE, ailerons=1800)
    fly(flight, aircraft, 1.0)
    flight.rig.imu.unplug()
    flight.rig.receiver.sticks(ailerons=1500)
    fly(flight, aircraft, 0.2)
    assert flight.servo_us("ailerons") == pytest.approx(1500, abs=1)
    flight.rig.imu.plug()
    fly(flight, aircraft, 3.0)
    assert flight.mode() == "f"
    # Rotation during the gap is unknown, and only slowly found.
    assert abs(aircraft.roll_deg) < 10
