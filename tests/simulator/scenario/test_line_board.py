import pytest

from up_simulator.scenario.event import SerialNoise
from up_simulator.scenario.line_board import FROM_BOARD, TO_BOARD, SerialWires

DATA = bytes(range(256)) * 40


def corrupt(noise, direction=TO_BOARD, seed=1):
    wires = SerialWires(seed)
    wires.set_noise(noise, 0.0)
    return wires.pass_on(DATA, direction, 0.0), wires


def test_without_noise_every_byte_arrives():
    assert SerialWires(1).pass_on(DATA, TO_BOARD, 0.0) == DATA


def test_an_unplugged_line_passes_nothing():
    wires = SerialWires(1)
    wires.is_plugged = False
    assert wires.pass_on(DATA, TO_BOARD, 0.0) == b""
    wires.is_plugged = True
    assert wires.pass_on(DATA, FROM_BOARD, 0.0) == DATA


def test_flipped_bytes_differ_in_one_bit():
    arrived, wires = corrupt(SerialNoise(flipped_percent=5))
    wrong = [(a ^ b).bit_count() for a, b in zip(DATA, arrived, strict=True) if a != b]
    assert set(wrong) == {1} and len(wrong) == wires.corrupted
    assert 0.04 < len(wrong) / len(DATA) < 0.06


@pytest.mark.parametrize(("kind", "sign"), [("inserted_percent", 1), ("lost_percent", -1)])
def test_bytes_are_inserted_and_lost(kind, sign):
    arrived, wires = corrupt(SerialNoise(**{kind: 5}))
    assert len(arrived) == len(DATA) + sign * wires.corrupted
    assert 0.04 < wires.corrupted / len(DATA) < 0.06


def test_the_same_seed_corrupts_the_same_bytes():
    noise = SerialNoise(flipped_percent=1, inserted_percent=1, lost_percent=1)
    assert corrupt(noise)[0] == corrupt(noise)[0] != corrupt(noise, seed=2)[0]


def test_noise_has_a_direction_and_an_end():
    noise = SerialNoise(for_s=2, lost_percent=100, direction=FROM_BOARD)
    wires = SerialWires(1)
    wires.set_noise(noise, 10.0)
    assert wires.pass_on(DATA, TO_BOARD, 10.5) == DATA
    assert wires.pass_on(DATA, FROM_BOARD, 11.9) == b""
    assert wires.pass_on(DATA, FROM_BOARD, 12.0) == DATA
