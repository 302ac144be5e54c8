"""Return set-points on the compiled firmware: the receiver is lost, the Raspberry Pi flies home."""

import pytest

from tests.arduino.commands import profile, setpoint
from tests.arduino.flight import HIGH, Flight

NOT_ALLOWED = 14
NOT_IN_FAILSAFE = 15
MAY_FLY, WITH_MOTOR = 2, 1
HOME = setpoint(roll=3000, throttle=1550)


def lost(flags):
    """Return an armed aircraft at AUTO with this profile whose receiver has just failed."""
    flight = Flight()
    flight.run_ms(1500)
    assert flight.ask("C", profile(throttle_failsafe_us=1100, flags=flags)) == "K"
    flight.run_ms(800)
    flight.arm()
    flight.sticks(200, aux1=HIGH, throttle=1400)
    assert flight.ask("R", HOME) == (NOT_IN_FAILSAFE if flags & MAY_FLY else NOT_ALLOWED)
    flight.rig.receiver.stop()
    flight.run_ms(1200)
    assert flight.status().is_failsafe
    return flight


def return_for(flight, duration_ms):
    for _ in range(duration_ms // 50):
        flight.send("R", HOME)
        flight.run_ms(50)


def test_the_board_flies_the_set_points_and_circles_when_they_stop():
    flight = lost(MAY_FLY | WITH_MOTOR)
    return_for(flight, 300)
    assert flight.status().mode_letter == "R"
    return_for(flight, 100)
    # Level, 30 degrees of bank demanded: 100 us more than for the circle.
    assert flight.servo_us("ailerons") > 1750
    assert flight.servo_us("throttle") == pytest.approx(1550, abs=1)
    flight.run_ms(300)
    assert flight.status().mode_letter == "f"
    assert flight.servo_us("throttle") == pytest.approx(1100, abs=1)


def test_a_receiver_that_is_back_gives_control_to_the_pilot_who_moves_a_stick():
    flight = lost(MAY_FLY | WITH_MOTOR)
    return_for(flight, 300)
    flight.rig.receiver.start()
    return_for(flight, 1500)
    assert flight.mode() == "R"
    return_for(flight, 100)
    flight.rig.receiver.sticks(ailerons=1800)
    return_for(flight, 150)
    assert flight.mode() == "f"
    assert not flight.status().is_failsafe


def test_without_the_profiles_bit_the_board_circles():
    flight = lost(WITH_MOTOR)
    return_for(flight, 300)
    assert flight.mode() == "f"
    assert flight.servo_us("throttle") == pytest.approx(1100, abs=1)
