"""The rig with the firmware itself: the same flight twice, and a daemon's view of it."""

import os
import random
import select
import time

import pytest

from tests.arduino.rig.firmware import make_rig
from tests.arduino.rig.test_program import DEADLINE_S, program
from tests.support.firmware import build_firmware
from up.protocols.checked_framing import cobs_decode, crc16
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


def test_the_firmware_answers_on_the_pty(elf):
    with program(elf, "--pty", "--imu", "rocking") as process:
        path = process.stdout.readline().removeprefix("board on ").strip()
        file = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        heard, types, asked_s = b"", set(), 0.0
        deadline_s = time.monotonic() + DEADLINE_S
        while not types >= set("KxirO"):
            assert time.monotonic() < deadline_s, f"heard {types} only"
            if time.monotonic() - asked_s > 1.0:
                asked_s = time.monotonic()
                os.write(file, b"\0" + checked_frame(0, "s"))
            if select.select([file], [], [], 0.1)[0]:
                heard += os.read(file, 4096)
            *frames, heard = heard.split(b"\0")
            for each in frames:
                frame = cobs_decode(each)
                if frame and len(frame) >= 4 and crc16(frame) == 0:
                    types.add(chr(frame[1]))
        os.close(file)
        process.terminate()
        assert process.wait(DEADLINE_S) == 0
