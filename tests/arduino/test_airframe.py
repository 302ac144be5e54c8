"""The profile on the compiled firmware: mixes, directions, trims, ends, motor, limits."""

import pytest

from tests.arduino.commands import SERVOS, profile, setpoint
from tests.arduino.flight import HIGH, LOW, MIDDLE, Flight
from up.commands.board_schema import Reason

A_DEGREE_US = 20
"""What the default gains make of a degree."""


@pytest.fixture(scope="module")
def shared():
    flight = Flight()
    flight.run_ms(1500)
    return flight


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


def test_no_servo_goes_beyond_its_ends(flight):
    ends = {"lowest_us": 1200, "highest_us": 1750, "trim_us": 100}
    fit(flight, dict.fromkeys(("ailerons", "elevator", "rudder"), ends))
    for stick, servo in ((1000, 1200), (2000, 1750), (2100, 1750), (900, 1200)):
        flight.sticks(ailerons=stick, elevator=stick, rudder=stick)
        expected = [servo, servo, 1000, servo]
        assert servos_us(flight) == pytest.approx(expected, abs=1)


def test_a_mix_is_turned_and_trimmed_for_each_servo(flight):
    fit(flight, {"elevator": {"reversed": 1, "trim_us": -30}}, mix=1)
    flight.sticks(ailerons=1600, elevator=1550)
    assert servos_us(flight) == pytest.approx([1450, 1320, 1000, 1500], abs=1)


def test_stabilisation_passes_the_mix_and_the_directions(flight):
    fit(flight, {"ailerons": {"reversed": 1}}, mix=1)
    flight.sticks(aux1=MIDDLE)
    flight.tilt(20)
    # To level, the right elevon goes one way and the left the other; the first one is reversed.
    left, right, *_ = servos_us(flight)
    assert left < 1400 and right < 1400
    flight.tilt(0)


def test_the_motors_servo_has_no_direction_nor_trim_that_could_start_it(flight):
    fit(flight, {"throttle": {"reversed": 1, "trim_us": 200, "lowest_us": 1100}})
    for throttle in (1000, 1500, 2000):
        flight.sticks(throttle=throttle)
        assert flight.servo_us("throttle") == pytest.approx(1000, abs=1)
    flight.arm()
    flight.sticks(throttle=1400)
    assert flight.servo_us("throttle") == pytest.approx(1400, abs=1)
    flight.sticks(throttle=2000)
    assert flight.servo_us("throttle") == pytest.approx(2000, abs=1)
    flight.sticks(400, throttle=LOW, aux2=LOW)
    assert not flight.status().is_armed


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


@pytest.mark.parametrize(
    ("channel", "stick", "attitude"),
    [
        ("ailerons", 2000, (50, 0)),
        ("ailerons", 1000, (-50, 0)),
        ("elevator", 2000, (0, 20)),
        ("elevator", 1000, (0, -25)),
        ("ailerons", 1750, (25, 0)),
    ],
)
def test_fbw_asks_for_its_limits_at_full_stick(flight, channel, stick, attitude):
    """When bank and pitch equal the stick's demand, the surfaces are at rest."""
    fit(flight)
    flight.tilt(*attitude)
    flight.sticks(**{channel: stick}, aux1=MIDDLE)
    assert flight.servo_us(channel) == pytest.approx(1500, abs=A_DEGREE_US)
    flight.tilt(0)
    assert abs(flight.servo_us(channel) - 1500) > 140


def test_a_setpoint_stays_within_fbws_limits(flight):
    fit(flight, roll_limit_cdeg=3000)
    flight.arm()
    flight.tilt(30)
    flight.sticks(aux1=HIGH)
    for _ in range(5):
        flight.send("S", setpoint(roll=9000))
        flight.run_ms(50)
    assert flight.mode() == "s"
    assert flight.servo_us("ailerons", 40) == pytest.approx(1500, abs=A_DEGREE_US)
    flight.sticks(400, aux2=LOW)
    flight.tilt(0)
