"""The chip on its bench as a board: what its receiver, its IMU and its resets do to it."""

import pytest

from tests.simulator.firmware.pair import Aboard
from up_rig import Motion
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.rig_board import RigBoard

LOW, MIDDLE, HIGH = 1000, 1500, 2000
FRAME_US = 20_000


@pytest.fixture
def aboard(elf):
    aboard = Aboard(RigBoard(elf, imu_errors=ImuErrors()))
    aboard.run_ms(1400)
    return aboard


@pytest.mark.parametrize("offset_us", range(0, FRAME_US, 1500))
def test_a_receiver_that_is_switched_at_any_time_never_sends_half_a_pulse(aboard, offset_us):
    aboard.sticks(ailerons=1400, elevator=1600, throttle=1000, rudder=1450)
    aboard.board.run_us(offset_us)
    for is_on in (False, True, True):
        aboard.board.set_receiver(is_on)
        aboard.run_ms(26)
    seen = set()
    for _ in range(40):
        aboard.run_ms(2)
        seen.add(tuple(round(each) for each in aboard.board.pulses_us()))
    assert seen == {(1400, 1600, 1000, 1450)}
    assert max(aboard.board.pulse_ages_us()) < 1.2 * FRAME_US


def test_time_is_exact_to_an_instruction(aboard):
    before_us = aboard.board.now_us
    for _ in range(500):
        aboard.board.run_us(2000)
    assert aboard.board.now_us - before_us == pytest.approx(1_000_000, abs=1)


def test_the_imu_measures_the_motion_with_its_errors(aboard):
    aboard.board.imu.errors = ImuErrors(gyro_bias_deg_s=(0, 0, 5))
    aboard.board.set_motion(Motion(yaw_rate_deg_s=20))
    aboard.status()
    assert aboard.tap.orientation.yaw_rate_deg_s == pytest.approx(25, abs=0.5)


def test_the_same_seed_has_the_same_bytes_and_another_has_not(elf):
    heard = []
    for seed in (1, 1, 2):
        aboard = Aboard(RigBoard(elf, seed=seed, imu_errors=ImuErrors()))
        aboard.run_ms(200)
        aboard.send("s")
        aboard.run_ms(1000)
        heard.append([(each.type, each.payload) for each in aboard.heard])
    assert heard[0] == heard[1]
    assert heard[0] != heard[2]
    assert len(heard[0]) > 30
