"""Pins, pin changes, interrupts, sleep, and what the rig measures of them."""

import time

import pytest

from tests.arduino.rig.firmware import build, make_rig
from up_rig import CrashError
from up_rig.pins import pin

LED = pin("D13")


@pytest.fixture
def case(tmp_path):
    def make(number, **options):
        options.setdefault("start_up_us", 100)
        return make_rig(build("pins", tmp_path, f"-DCASE={number}"), **options)

    return make


def test_a_driven_input_keeps_its_level_when_port_is_written(case):
    rig = case(1)
    rig.receiver.edge("ailerons", 16 * 200, 1)
    rig.receiver.edge("aux1", 16 * 200, 2)
    rig.run_us(5000)
    # D2 is driven high, D7 is let go and pulled up, the others are driven low.
    assert rig.serial.read() == bytes([0x84] * 4 + [8]) + b"\xee"


def test_edges_at_one_moment_cost_one_interrupt_and_lose_nothing(case):
    rig = case(2)
    at = 16 * 600
    for channel in ("ailerons", "elevator", "throttle"):
        rig.receiver.edge(channel, at, 1)
    rig.run_us(5000)
    said = rig.serial.read()
    assert said[:2] == bytes([0, 1])
    assert said[2] & 0xF4 == 0x34


def test_a_change_while_interrupts_are_off_is_kept(case):
    rig = case(2)
    rig.receiver.edge("rudder", 16 * 1200, 1)
    rig.run_us(5000)
    said = rig.serial.read()
    assert said[:2] == bytes([4, 1])
    assert said[2] & 0xF4 == 0x40


def test_two_edges_closer_than_an_interrupt_are_two_interrupts(case):
    rig = case(2)
    rig.receiver.glitch("rudder", 600, 1.0)
    rig.run_us(5000)
    said = rig.serial.read()
    assert said[1] == 2
    assert [level & 0xF4 for level in said[2:4]] == [0, 0]


def test_entering_an_interrupt_takes_its_cycles(case):
    rig = case(3)
    latencies = set()
    for number in range(40):
        edge = 16 * 500 + number * 161
        rig.receiver.edge("aux2", edge, 1 - number % 2)
        rig.run_until_us(edge / 16 + 9)
        rises = [cycle for cycle, level in rig.servo.pin_edges(LED) if level]
        latencies.add(rises[-1] - edge)
    # 3 to the flag, up to 2 of the running instruction, 4 of entry, 3 of the vector's jump, 2 of
    # SBI: at least the sum of the certain ones.
    assert min(latencies) == 3 + 4 + 3 + 2
    assert max(latencies) <= 12 + 3


def test_one_instruction_runs_before_each_of_two_interrupts(case):
    rig = case(8)
    rig.run_us(2000)
    # The bits that the program has set when each interrupt looks.
    assert list(rig.serial.read()) == [0b001, 0b011, 0xEE]


def test_sleeping_takes_simulated_time_alone(case):
    rig = case(4)
    rig.receiver.edge("ailerons", 16 * 1_000_000_000, 1)
    begun_s = time.monotonic()
    rig.run_us(999_000_000)
    assert rig.serial.read() == b""
    rig.run_us(2_000_000)
    assert rig.serial.read() == b"\x01\xee"
    assert rig.measures().sleep_cycles > 999e6 * 16
    # A thousand seconds, were the process to sleep as well.
    assert time.monotonic() - begun_s < 500


def test_time_without_interrupts_and_the_stack_are_measured(case):
    rig = case(5, is_measuring=True)
    rig.run_until_us(101)
    rig.clear_measures()
    rig.run_us(2000)
    measures = rig.measures()
    assert 1000 <= measures.longest_off_cycles <= 1006
    assert 3 <= measures.stack_bytes <= 8


def test_without_measuring_the_same_happens(case):
    said = []
    for is_measuring in (True, False):
        rig = case(2, is_measuring=is_measuring)
        rig.receiver.glitch("rudder", 600, 1.0)
        rig.receiver.edge("throttle", 16 * 1234, 1)
        rig.run_us(5000)
        said.append([(each.cycle, each.value) for each in rig.serial.read_stamped()])
    assert said[0] == said[1] != []


@pytest.mark.parametrize("is_measuring", [True, False])
def test_an_edge_that_is_added_between_two_runs_comes_at_its_cycle(case, is_measuring):
    rig = case(3, is_measuring=is_measuring)
    rig.run_us(500)
    for number in range(10):
        edge = rig.cycle + 55
        rig.receiver.edge("aux2", edge, 1 - number % 2)
        rig.run_us(100)
        rises = [cycle for cycle, level in rig.servo.pin_edges(LED) if level]
        assert 12 <= rises[-1] - edge <= 15


@pytest.mark.parametrize(
    ("number", "code", "value"),
    [
        (6, "not_modelled", "INT0"),
        (7, "wild_program", "0x"),
        (9, "wild_program", "0x"),
        (10, "wild_program", "0x"),
        (11, "wild_stack", "0x0010"),
    ],
)
def test_a_crash_has_its_code_and_stays(case, number, code, value):
    rig = case(number)
    if code == "wild_stack":
        rig.receiver.edge("ailerons", 16 * 500, 1)
    with pytest.raises(CrashError, match=value) as caught:
        rig.run_us(1000)
    assert caught.value.code == code
    with pytest.raises(CrashError):
        rig.run_us(1)
