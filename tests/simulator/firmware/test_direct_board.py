"""Without a flight computer the servos have the receiver's pulses, and nothing else."""

import math

import pytest

from up_rig.imu import Motion
from up_simulator.firmware.board import NEUTRAL_US, FirmwareBoard
from up_simulator.firmware.direct_board import FRAME_US, DirectBoard


@pytest.fixture
def board():
    board: FirmwareBoard = DirectBoard(seed=1)
    board.run_us(100_000)
    return board


def test_before_the_first_frame_there_are_no_pulses():
    board = DirectBoard(seed=1)
    assert board.pulses_us() == NEUTRAL_US
    assert board.pulse_ages_us() == (math.inf,) * 4


def test_a_stick_moves_its_servo_from_the_next_frame_on(board):
    board.set_stick("rudder", 1234)
    board.set_stick("aux1", 2000)
    assert board.pulses_us() == NEUTRAL_US
    board.run_us(FRAME_US + 9_000)
    assert board.pulses_us() == (1500, 1500, 1000, 1234)


def test_pulses_come_in_the_order_of_the_channels_every_20_ms(board):
    ages = []
    for _ in range(200):
        board.run_us(1000)
        ages.append(board.pulse_ages_us())
    for servo in range(4):
        assert max(each[servo] for each in ages) < FRAME_US + 1000
    newest = min(ages)
    assert newest[0] == pytest.approx(newest[3], abs=FRAME_US)


def test_a_receiver_that_is_off_leaves_the_servos_where_they_were(board):
    board.set_stick("ailerons", 1700)
    board.run_us(2 * FRAME_US)
    board.set_receiver(False)
    board.set_stick("ailerons", 1300)
    board.run_us(100_000)
    assert board.pulses_us()[0] == 1700
    assert min(board.pulse_ages_us()) > 80_000
    board.set_receiver(True)
    board.run_us(2 * FRAME_US)
    assert board.pulses_us()[0] == 1300


def test_one_channel_may_be_silent_alone(board):
    board.set_channel("elevator", False)
    board.run_us(100_000)
    ages = board.pulse_ages_us()
    assert ages[1] > 80_000 and ages[0] < 2 * FRAME_US
    board.set_channel("elevator", True)
    board.run_us(2 * FRAME_US)
    assert board.pulse_ages_us()[1] < 2 * FRAME_US


def test_nothing_else_aboard_does_anything(board):
    board.set_motion(Motion(roll_rate_deg_s=90))
    board.write(b"\0\1\2")
    board.imu.set_fault("stuck")
    board.reset("watchdog")
    board.run_us(50_000)
    assert board.read() == board.eeprom == b""
    assert board.imu.fault == "stuck"
    assert board.pulses_us() == NEUTRAL_US
