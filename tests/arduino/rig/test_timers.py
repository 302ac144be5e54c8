"""The timers as the data sheet has them (15 to 18), where simavr's are not."""

import itertools

import pytest

from tests.arduino.rig.firmware import build, make_rig
from up_rig.pins import pin

TICK = 8
ROUND = 256 * TICK
LED, OC2A, OC2B, OC1A = pin("D13"), pin("D11"), pin("D3"), pin("D9")


@pytest.fixture
def case(tmp_path):
    def run(number, duration_us=20_000):
        rig = make_rig(build("timers", tmp_path, f"-DCASE={number}"), start_up_us=100)
        rig.run_us(duration_us)
        said = rig.serial.read()
        assert said[-1:] == b"\xee", f"case {number} did not end"
        return rig, said[:-1]

    return run


def words(said):
    return [int.from_bytes(said[at : at + 2], "big") for at in range(0, len(said), 2)]


def test_the_count_is_read_exactly(case):
    _rig, said = case(1)
    reads = words(said)
    # 800 cycles of waiting plus those of the loop, 100 ticks and a few.
    steps = {after - before for before, after in itertools.pairwise(reads)}
    assert len(steps) <= 2
    assert all(100 < step <= 104 for step in steps)


def test_a_compare_value_that_was_passed_matches_in_the_next_round(case):
    rig, _said = case(2)
    (rise, is_high), (fall, is_still) = rig.servo.pin_edges(OC2A)
    assert (is_high, is_still) == (1, 0)
    (armed, _), (ended, _) = rig.servo.pin_edges(LED)
    # Armed at count 100 and a little: the match at 90 comes almost a round later.
    assert ROUND - 20 * TICK < rise - armed < ROUND - 10 * TICK
    assert fall - rise == (120 - 90) * TICK
    assert fall < ended


def test_rounds_of_a_timer_move_no_pin(case):
    rig, _said = case(3)
    edges = rig.servo.pin_edges(OC2B)
    # The latch is low; PORT is seen while the pin is not the timer's; then the match sets it.
    assert [level for _cycle, level in edges] == [1, 0, 1]
    port_shown, timer_back, matched = (cycle for cycle, _level in edges)
    assert timer_back - port_shown == pytest.approx(16 * 100, abs=16)
    assert 0 < matched - timer_back <= ROUND


def test_prescalers_that_are_let_go_together_run_in_step(case):
    rig, said = case(4)
    assert words(said) == [0]
    match, _level = rig.servo.pin_edges(OC1A)[0]
    assert (match, 1) == rig.servo.pin_edges(OC2A)[0]
    # The prescaler begins at zero, too; the LED's SBI ends 2 cycles after the store that starts it.
    assert match - rig.servo.pin_edges(LED)[0][0] == 200 * TICK - 2


def test_a_flag_waits_for_its_mask(case):
    _rig, said = case(5)
    assert list(said) == [0, 1, 2, 0, 1]


def test_sbi_clears_one_flag(case):
    _rig, said = case(6)
    assert list(said) == [7, 5]


def test_a_write_of_the_count_hides_one_match(case):
    rig, said = case(7)
    assert list(said) == [0, 2]
    assert [level for _cycle, level in rig.servo.pin_edges(OC2A)][:2] == [1, 0]


def test_sixteen_bit_registers_share_their_high_byte(case):
    _rig, said = case(8)
    # Writing OCR1AH left 0x34 in TEMP, which went into TCNT1 with its low byte.
    assert said[0] == 0x34
    assert list(said[2:]) == [0, 0]


def test_overflows_come_every_round(case):
    _rig, said = case(9)
    assert words(said)[0] < 60
