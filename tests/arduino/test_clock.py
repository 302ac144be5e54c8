"""The firmware's clock wraps in flight, and nothing happens."""

import itertools

import pytest

from tests.arduino.flight import Flight


@pytest.fixture
def near_wrap():
    """Return a flight that wraps its 32 bits of microseconds 4 s after it started."""
    flight = Flight(boots=False, aux1=1500)
    names = flight.rig.firmware.symbols
    clock = next(name for name in names if "clock" in name and "overflows" in name)
    flight.rig.preload(clock, (2**17 - 120).to_bytes(4, "little"))
    return flight


def test_the_wrap_of_the_microseconds_is_not_felt(near_wrap):
    flight = near_wrap
    flight.run_ms(3000)
    flight.arm()
    flight.send("s")
    flight.run_ms(100)
    del flight.messages[:]
    flight.rig.servo.clear()
    flight.run_ms(1500)
    for letter in "iOr":
        stamps = [each.cycle for each in flight.messages if each.type == letter]
        gaps_ms = [(b - a) / 16000 for a, b in itertools.pairwise(stamps)]
        assert 70 <= len(stamps) <= 80
        assert max(gaps_ms) < 40
    for channel in ("ailerons", "elevator", "throttle", "rudder"):
        pulses = flight.rig.servo.pulses(channel)
        rises = [each.rise_cycle for each in pulses]
        gaps_us = [(b - a) / 16 for a, b in itertools.pairwise(rises)]
        assert max(abs(each - 20_000) for each in gaps_us) < 10
        assert max(abs(each.width_us - pulses[0].width_us) for each in pulses) < 20
    status = flight.status()
    assert status.is_armed
    assert not status.is_failsafe
    assert status.late_us < 200
    assert status.rx_age_ms < 30


def test_lifetimes_end_across_the_wrap(near_wrap):
    flight = near_wrap
    flight.run_ms(3500)
    flight.rig.receiver.stop()
    flight.run_ms(1200)
    assert flight.status().is_failsafe
    flight.send("v", b"\1")
    flight.run_ms(100)
    assert flight.status().vetoes & 16
    flight.run_ms(1100)
    assert not flight.status().vetoes & 16
