"""The IMU on its bus: values, true bit times, and everything that a bus can do to a program."""

import itertools
import struct

import pytest

from tests.arduino.rig.firmware import build, make_rig
from up_rig import Motion
from up_rig.imu import GRAVITY_M_S2, Fault, motion_at

TIMEOUT, OK = 0xFF, 0
TRANSFER_BYTES = 16
"""Of the second transfer of a burst: its address and 14 bytes; the first has 2."""


@pytest.fixture
def case(tmp_path):
    def make(number, rate=12):
        elf = build("imu", tmp_path, f"-DCASE={number}", f"-DRATE={rate}")
        rig = make_rig(elf, start_up_us=100)
        rig.imu.noise_deg_s = rig.imu.noise_m_s2 = 0.0
        return rig

    return make


def bursts(rig, duration_us=20_000):
    """Run on and return the statuses and bytes of the bursts."""
    rig.serial.read()
    rig.run_us(duration_us)
    said = rig.serial.read_stamped()
    # The two bytes of a burst follow each other; a run may begin or end between them.
    return [
        (status.value, byte.value)
        for status, byte in itertools.pairwise(said)
        if byte.cycle - status.cycle < 16 * 100
    ]


def test_it_wakes_up_and_measures(case):
    rig = case(1)
    rig.imu.motion = Motion(100.0, -50.0, 25.0, 0.0, GRAVITY_M_S2, -GRAVITY_M_S2)
    rig.run_us(60_000)
    said = rig.serial.read()
    assert list(said[:3]) == [0x68, 0x40, 0], "it sleeps and measures nothing before"
    accel_and_gyro = struct.unpack(">7h", said[3:17])
    # The sensor is mounted x forward, y left, z up; +-4 g and +-1000 deg/s are set.
    assert accel_and_gyro[:3] == (0, -8192, 8192)
    assert accel_and_gyro[3] == round((25 - 36.53) * 340)
    assert accel_and_gyro[4:] == (3275, 1638, -819)
    assert list(said[17:]) == [0x10, 0x08, 0xEE]
    assert rig.imu.register(26) == 2


@pytest.mark.parametrize("rate, bit", [(12, 40), (72, 160), (0, 16)])
def test_bits_take_the_time_of_the_rate_register(case, rate, bit):
    rig = case(2, rate)
    rig.run_us(40_000)
    said = rig.serial.read()
    assert said[-1] == 0xEE
    times = struct.unpack(">4H", said[:8])
    # A start and a stop take a bit, a byte nine; the program adds the steps of its polling.
    for took, bits in zip(times, (1, 9, 9, 1), strict=True):
        assert 0 <= took - bits * bit < 60


def test_a_function_of_time_moves_it(case):
    rig = case(3)
    rig.imu.motion = lambda time_s: Motion(roll_rate_deg_s=-100.0 * (time_s > 0.05))
    rig.run_until_us(35_000)
    assert set(bursts(rig, 14_000)) == {(OK, 0)}
    assert bursts(rig, 30_000)[-1] == (OK, struct.pack(">h", -13100)[1])


def test_an_exception_of_the_motion_is_raised_by_the_run(case):
    def fall(_time_s):
        raise OverflowError

    rig = case(3)
    rig.imu.motion = fall
    with pytest.raises(OverflowError):
        rig.run_us(50_000)


def test_noise_and_bias_are_the_same_for_the_same_seed(case):
    def fly():
        rig = case(3)
        rig.imu.noise_deg_s, rig.imu.bias_deg_s = 0.3, (1.5, 0.0, 0.0)
        rig.run_us(40_000)
        return bursts(rig)

    assert fly() == fly()
    assert len({value for _status, value in fly()}) > 5


def test_an_imu_that_is_not_there_does_not_answer(case):
    rig = case(3)
    rig.imu.unplug()
    rig.run_us(40_000)
    assert set(bursts(rig)) == {(0x20, 0xAA)}
    rig.imu.plug()
    rig.run_us(40_000)
    # It is back, but asleep, as no register write has woken it.
    assert set(bursts(rig)) == {(OK, 0)}


EACH_BYTE = pytest.mark.parametrize("byte", range(2 + TRANSFER_BYTES - 1))


def failing_at(rig, byte, fault):
    """Run the sampling program; from a byte of its burst on the sensor fails."""
    rig.run_us(40_000)
    first = byte < 2
    rig.imu.fail_at_byte(byte if first else byte - 2, fault, after_transfers=not first)
    return rig


def assert_works(rig):
    rig.imu.mend()
    rig.run_us(5_000)
    assert {status for status, _ in bursts(rig)} == {OK}


@EACH_BYTE
def test_the_data_line_held_at_any_byte_never_hangs_the_bench(case, byte):
    rig = failing_at(case(3), byte, Fault.SDA_LOW)
    rig.run_us(5_000)
    later = bursts(rig)
    # A start needs a free bus: TWINT is never set, whatever the program tries.
    assert len(later) > 3
    assert {status for status, _ in later} == {TIMEOUT}
    assert_works(rig)


@EACH_BYTE
def test_the_clock_held_at_any_byte_stops_that_byte(case, byte):
    rig = failing_at(case(3), byte, Fault.SCL_LOW)
    later = bursts(rig)
    assert OK in {status for status, _ in later[:2]} or byte < 17
    assert later[-1][0] == TIMEOUT
    assert rig.imu.fault is Fault.SCL_LOW
    assert_works(rig)


@EACH_BYTE
def test_gone_at_any_byte_is_no_answer(case, byte):
    rig = failing_at(case(3), byte, Fault.NO_ANSWER)
    seen = bursts(rig)
    assert seen[-1] == (0x20, 0xAA)
    # An address or register without a device is not acknowledged and reads as ones.
    expected = {0: 0x20, 1: 0x30, 2: 0x48}.get(byte, OK)
    changed = next(each for each in seen if each != (OK, 0))
    assert changed[0] in (expected, 0x20)
    if 2 < byte <= 12:
        assert changed == (OK, 0xFF)
    assert_works(rig)


def test_a_sensor_that_hangs_in_a_byte_is_freed_by_clocks(case):
    hung, freed = case(3), case(4)
    for rig in (hung, freed):
        rig.run_us(40_000)
        rig.imu.fail_at_byte(5, Fault.HANGS, after_transfers=1)
        rig.run_us(10_000)
    assert {status for status, _ in bursts(hung)} == {TIMEOUT}
    assert {status for status, _ in bursts(freed)} == {OK}


def test_frozen_repeats_and_garbage_does_not(case):
    rig = case(3)
    rig.imu.noise_deg_s = 20.0
    rig.run_us(40_000)
    assert len(set(bursts(rig))) > 3
    rig.imu.is_frozen = True
    rig.run_us(3_000)
    assert len(set(bursts(rig))) == 1
    rig.imu.is_frozen, rig.imu.is_garbage = False, True
    assert len(set(bursts(rig))) > 3


def test_another_part_has_another_identity(case):
    rig = case(1)
    rig.imu.set_identity(0x98)
    rig.run_us(60_000)
    assert rig.serial.read()[0] == 0x98


def test_attitudes_stand_still():
    assert motion_at(0, 0).force_z_m_s2 == -GRAVITY_M_S2
    banked = motion_at(30, 0)
    assert banked.force_y_m_s2 == pytest.approx(-GRAVITY_M_S2 / 2)
    climbing = motion_at(0, 30)
    assert climbing.force_x_m_s2 == pytest.approx(GRAVITY_M_S2 / 2)
