"""The ADC as the data sheet has it (24), and what the rig does not model stops the program."""

import pytest

from tests.arduino.rig.firmware import build, make_rig
from up_rig import CrashError

ADC_CLOCK = 128
A7 = 7


@pytest.fixture
def case(tmp_path):
    def load(number, volts=0.0):
        rig = make_rig(build("adc", tmp_path, f"-DCASE={number}"), start_up_us=100)
        rig.set_analog(A7, volts)
        return rig

    return load


def words(rig):
    said = rig.serial.read()
    return [int.from_bytes(said[at : at + 2], "big") for at in range(0, len(said) - 1, 2)]


@pytest.mark.parametrize(
    ("volts", "count"), [(0.0, 0), (0.55, 512), (1.0989, 1022), (1.1, 1023), (5.0, 1023)]
)
def test_a_conversion_takes_13_clocks_the_first_25_and_counts_in_1_1_volt(case, volts, count):
    rig = case(1, volts)
    rig.run_us(20_000)
    first, second, right, left = words(rig)
    assert first == pytest.approx(25 * ADC_CLOCK, abs=20)
    assert second == pytest.approx(13 * ADC_CLOCK, abs=20)
    assert (right, left) == (count, count << 6)


def test_free_running_converts_every_13_clocks(case):
    rig = case(2, 0.5)
    rig.run_us(20_000)
    first, second, third = words(rig)
    assert second - first == pytest.approx(13 * ADC_CLOCK, abs=20)
    assert third - second == pytest.approx(13 * ADC_CLOCK, abs=20)


def test_the_low_byte_locks_the_result(case):
    rig = case(3, 0.275)
    rig.run_us(10_000)
    rig.set_analog(A7, 0.84)
    rig.run_us(30_000)
    assert words(rig) == [256, 781]


@pytest.mark.parametrize("number", [4, 5])
def test_what_is_not_modelled_stops_the_program(case, number):
    rig = case(number)
    with pytest.raises(CrashError) as caught:
        rig.run_us(20_000)
    assert caught.value.code == "not_modelled"
