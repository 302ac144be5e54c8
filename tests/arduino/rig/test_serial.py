"""The serial line: true rates, a receiver of two bytes, errors."""

import itertools

import pytest

from tests.arduino.rig.firmware import build, make_rig

START_UP_US = 100
BIT_US = 1e6 / 115200


@pytest.fixture
def case(tmp_path):
    def make(number):
        return make_rig(build("serial", tmp_path, f"-DCASE={number}"), start_up_us=START_UP_US)

    return make


def test_bytes_come_back_in_order_at_the_rate_of_the_line(case):
    rig = case(1)
    rig.run_us(1000)
    message = bytes(range(256))
    rig.serial.write(message)
    rig.run_us(256 * 10 * BIT_US - 50)
    assert rig.serial.waiting == 1
    rig.run_us(500)
    stamped = rig.serial.read_stamped()
    assert bytes(each.value for each in stamped) == message
    assert rig.serial.overruns == 0


def test_a_frame_has_ten_bits_of_the_chips_own_rate(case):
    rig = case(3)
    rig.run_us(20_000)
    stamped = rig.serial.read_stamped()
    steps = {after.cycle - before.cycle for before, after in itertools.pairwise(stamped)}
    # UBRR 16 and U2X: 17 * 8 cycles a bit (117,647 Bd).
    assert steps == {10 * 17 * 8}


def test_a_receiver_that_is_not_read_keeps_three_bytes(case):
    rig = case(2)
    rig.run_us(START_UP_US + 50)
    rig.serial.write(b"abcdef")
    rig.run_us(5000)
    said = rig.serial.read()
    assert said == bytes([0, ord("a"), 0, ord("b"), 8, ord("c")]) + b"\xee"
    assert rig.serial.overruns == 3


def test_a_broken_stop_bit_is_a_framing_error(case):
    rig = case(2)
    rig.run_us(START_UP_US + 50)
    rig.serial.write(b"a")
    rig.serial.write(b"b", broken=True)
    rig.run_us(5000)
    assert rig.serial.read() == bytes([0, ord("a"), 0x10, ord("b")]) + b"\xee"


def test_the_wrong_rate_is_noise(case):
    rig = case(2)
    rig.run_us(START_UP_US + 50)
    rig.serial.set_baud(9600)
    rig.serial.write(b"a")
    rig.run_us(5000)
    status, _value, end = rig.serial.read()
    assert (status, end) == (0x10, 0xEE)


def test_bytes_during_a_reset_are_lost(case):
    rig = case(1)
    rig.run_us(1000)
    rig.press_reset()
    rig.serial.write(b"x")
    rig.run_us(START_UP_US - 10)
    assert rig.serial.waiting == 0
    rig.run_us(2000)
    assert rig.serial.read() == b""
    rig.serial.write(b"y")
    rig.run_us(500)
    assert rig.serial.read() == b"y"
