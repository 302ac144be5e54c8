"""The receiver on the compiled firmware: lost on any wire in any way, noise, storms, its return."""

import itertools
import random

import pytest

from tests.arduino.commands import profile
from tests.arduino.flight import FRAME_US, HIGH, LOW, MIDDLE, RECEIVER, Flight

CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
SERVOS = CHANNELS[:4]


@pytest.fixture(scope="module")
def shared():
    flight = Flight()
    flight.run_ms(1500)
    assert flight.ask("C", profile(throttle_failsafe_us=1150, preset_ailerons_us=1580)) == "K"
    flight.run_ms(800)
    flight.arm()
    flight.send("s")
    return flight


@pytest.fixture
def fbw(shared):
    """Return an armed aircraft in FBW, level, with 1400 us of throttle and all wires alive."""
    shared.rig.imu.plug()
    shared.rig.receiver.start()
    shared.sticks(200, ailerons=1500, elevator=1500, rudder=1500, throttle=LOW, aux2=HIGH)
    shared.sticks(300, aux1=MIDDLE, throttle=1400)
    status = shared.status()
    assert status.is_armed and not status.is_failsafe and status.flags & RECEIVER
    return shared


def stays_low(receiver, channel):
    receiver.stop(channel)


def stays_high(receiver, channel):
    receiver.stop(channel, level=1)


def too_narrow(receiver, channel):
    receiver.set(channel, 870)


def too_wide(receiver, channel):
    receiver.set(channel, 2130)


def inputs(flight):
    """Return validity bits of the newest `i`."""
    return flight.newest("i").payload[12]


def assert_frames(pulses):
    """Assert that no servo frame is shorter than 6 ms, and that none is missing for long."""
    gaps_us = [(b.rise_cycle - a.rise_cycle) / 16 for a, b in itertools.pairwise(pulses)]
    assert min(gaps_us) >= 5_999
    assert max(gaps_us) <= 60_000


@pytest.mark.parametrize("loss", [stays_low, stays_high, too_narrow, too_wide])
@pytest.mark.parametrize("channel", CHANNELS)
def test_each_wire_lost_in_each_way(fbw, channel, loss):
    width = {"throttle": 1400, "aux1": MIDDLE, "aux2": HIGH}.get(channel, 1500)
    loss(fbw.rig.receiver, channel)
    # The next `i` may have been measured 5 ms ago.
    fbw.run(FRAME_US + 105_000)
    bit = 1 << CHANNELS.index(channel)
    assert inputs(fbw) == 0x3F & ~bit
    # Half a second is ridden through with the throttle that was there.
    assert fbw.servo_us("throttle", 60) == pytest.approx(1400, abs=1)
    fbw.run_ms(1000 - 100 - 60 - 10)
    for name, least, most in (("ailerons", 1560, 2000), ("throttle", 1149, 1151)):
        assert least <= fbw.servo_us(name, 30) <= most, name
    status = fbw.status()
    assert status.is_failsafe and status.is_armed
    assert status.mode_letter == "f"
    fbw.rig.receiver.resume(channel)
    fbw.rig.receiver.set(channel, width)
    fbw.run_ms(150)
    status = fbw.status()
    assert not status.is_failsafe and status.is_armed
    assert fbw.servo_us("throttle") == pytest.approx(1400, abs=1)
    assert fbw.servo_us("ailerons") == pytest.approx(1500, abs=5)


@pytest.mark.parametrize("switch", [LOW, MIDDLE, HIGH])
def test_a_silent_receiver_makes_a_gentle_circle(fbw, switch):
    fbw.sticks(aux1=switch, ailerons=1200, elevator=1900)
    fbw.rig.receiver.stop()
    fbw.run_ms(700)
    # Level, and a bank of 20 degrees to the right is wanted, and 3 degrees nose down.
    assert fbw.servo_us("ailerons") > 1560
    assert fbw.servo_us("elevator") < 1500
    fbw.tilt(20, -3, seconds=0.3)
    assert fbw.servo_us("ailerons") == pytest.approx(1500, abs=5)
    assert fbw.servo_us("elevator") == pytest.approx(1500, abs=5)
    assert fbw.servo_us("rudder") == pytest.approx(1500, abs=5)
    assert fbw.servo_us("throttle") == pytest.approx(1150, abs=1)
    fbw.tilt(0, seconds=0.3)


@pytest.mark.parametrize("period_ms", [7, 14, 22])
def test_receivers_of_other_makes_are_as_good(fbw, period_ms):
    fbw.rig.receiver.is_simultaneous = True
    fbw.rig.receiver.period_us = period_ms * 1000
    try:
        fbw.sticks(200, ailerons=1300, aux1=LOW)
        fbw.rig.servo.clear()
        fbw.run_ms(300)
        pulses = fbw.rig.servo.pulses("ailerons")
        assert len(pulses) == pytest.approx(300 / period_ms, abs=2)
        assert [each.width_us for each in pulses] == pytest.approx([1300] * len(pulses), abs=1)
        assert fbw.status().flags & RECEIVER
    finally:
        fbw.rig.receiver.is_simultaneous = False
        fbw.rig.receiver.period_us = FRAME_US


def test_short_noise_on_all_wires_changes_nothing(fbw):
    """Spikes of 1 to 250 us, on every wire, between and within pulses."""
    source = random.Random(5)
    fbw.sticks(aux1=LOW, ailerons=1600)
    fbw.rig.servo.clear()
    start_us = fbw.rig.now_us + 1000
    for at in range(240):
        # After the last pulse of a frame and before the next: there all wires are low.
        frame_us = start_us // FRAME_US * FRAME_US
        when_us = frame_us + at // 3 * 5_000 + source.uniform(0, 4_000)
        fbw.rig.receiver.glitch(source.choice(CHANNELS), when_us, source.uniform(1, 250))
    fbw.run_ms(600)
    status = fbw.status()
    assert status.is_armed and not status.is_failsafe
    assert (status.switch, status.mode_letter) == (0, "a")
    for name in SERVOS:
        pulses = fbw.rig.servo.pulses(name)
        assert all(880 <= each.width_us <= 2120 for each in pulses)
        assert_frames(pulses)


@pytest.mark.parametrize("channel", ["ailerons", "throttle", "aux2"])
@pytest.mark.parametrize("half_us", [2, 7, 40, 150])
def test_a_storm_on_a_wire_is_a_lost_wire_and_no_more(fbw, channel, half_us):
    fbw.rig.servo.clear()
    start_us = fbw.rig.now_us + 100
    fbw.rig.receiver.stop(channel)
    for at in range(int(900_000 / (2 * half_us))):
        fbw.rig.receiver.glitch(channel, start_us + at * 2 * half_us, half_us)
    fbw.run_ms(950)
    status = fbw.status()
    assert status.is_armed and status.is_failsafe
    assert not status.reset_cause & 0x80
    assert status.uptime_s > 2
    for name in SERVOS:
        pulses = fbw.rig.servo.pulses(name)
        assert len(pulses) >= 30
        assert all(999 <= each.width_us <= 2001 for each in pulses)
        assert_frames(pulses)
    fbw.rig.receiver.resume(channel)
    fbw.run_ms(200)
    assert not fbw.status().is_failsafe
    assert fbw.servo_us("throttle") == pytest.approx(1400, abs=1)
