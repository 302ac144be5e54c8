"""The rig with the firmware itself: the same flight twice."""

import random

import pytest

from tests.arduino.rig.firmware import make_rig
from tests.support.firmware import build_firmware
from up_rig import CHANNELS, SERVOS
from up_rig.imu import motion_at
from up_simulator.firmware.wire import checked_frame


@pytest.fixture(scope="module")
def elf():
    return build_firmware()


def rough_flight(elf, **options):
    """Fly two seconds of noise, faults and resets; return all that the rig recorded."""
    rig = make_rig(elf, seed=5, **options)
    chance = random.Random(3)
    rig.receiver.jitter_us, rig.receiver.period_jitter_us = 1.0, 30.0
    rig.receiver.start(at_us=70_000)
    rig.imu.motion = lambda time_s: motion_at(10 * time_s % 20, 3)
    rig.run_us(1_500_000)
    rig.serial.write(b"\0" + checked_frame(0, "s"))
    sent = []
    for _ in range(200):
        rig.run_us(chance.uniform(1, 20_000))
        rig.receiver.set(chance.choice(CHANNELS), chance.uniform(900, 2100))
        if chance.random() < 0.3:
            rig.serial.write(chance.randbytes(chance.randrange(30)))
        if chance.random() < 0.3:
            at_us, width_us = rig.now_us + chance.uniform(1, 500), chance.uniform(0.2, 900)
            rig.receiver.glitch(chance.choice(CHANNELS), at_us, width_us)
        if chance.random() < 0.05:
            rig.imu.unplug()
        if chance.random() < 0.2:
            rig.imu.plug()
        if chance.random() < 0.02:
            rig.force_watchdog_reset()
        sent += rig.serial.read_stamped()
    return sent, [rig.servo.edges(channel) for channel in SERVOS], rig.measures().resets


def test_a_rough_flight_is_the_same_to_the_cycle_with_and_without_measures(elf):
    sent, edges, resets = first = rough_flight(elf)
    assert len(sent) > 100 and all(len(each) > 100 for each in edges) and resets[3] > 1
    assert rough_flight(elf, is_measuring=False) == first
