"""The host build alone: every flight repeats, boards are independent, missing tools are named."""

import _ctypes
import random
import struct

import pytest

from tests.simulator.firmware.pair import Aboard, rocking
from up_rig import RigUnavailableError
from up_simulator.firmware.host_board import HostBoard
from up_simulator.firmware.imu_errors import ImuErrors

GAINS = struct.pack(">18f", *(0.125 * (1 + at) for at in range(18)))


def script(board):
    """Do a little of everything and return all that came of it."""
    each = Aboard(board)
    chance = random.Random(8)
    said = []
    each.send("s")
    for at in range(300):
        board.set_stick(chance.choice(("ailerons", "throttle", "aux1", "aux2")), 1000 + 5 * at)
        board.set_motion(rocking(at / 50))
        board.run_us(chance.choice((777.7, 2000, 5000)))
        data = board.read()
        said.append((data, board.pulses_us(), board.now_us))
        if at % 40 == 7:
            each.send("g", GAINS)
    return said, board.eeprom


def test_the_same_calls_give_the_same_flight(library):
    flights = [script(HostBoard(library, seed=7, imu_errors=ImuErrors())) for _ in range(2)]
    assert flights[0] == flights[1]
    other = script(HostBoard(library, seed=8, imu_errors=ImuErrors()))
    assert other != flights[0]


def test_how_long_a_run_is_makes_no_difference(library):
    whole, parts = (HostBoard(library, seed=3, imu_errors=ImuErrors()) for _ in range(2))
    whole.write(b"\0")
    parts.write(b"\0")
    whole.run_us(400_000)
    for _ in range(4000):
        parts.run_us(100)
    assert whole.now_us == pytest.approx(parts.now_us) == 400_000
    assert whole.pulses_us() == parts.pulses_us()
    assert whole.pulse_ages_us() == pytest.approx(parts.pulse_ages_us())
    assert whole.read() == parts.read()


def test_power_on_forgets_all_but_the_eeprom(library):
    old = HostBoard(library, imu_errors=ImuErrors())
    script(old)
    old.set_receiver(False)
    old.imu.set_fault("unplugged")
    # The receiver's unfinished input, the data still on the line, and pending EEPROM writes.
    old.run_us(100_000)
    old.read()
    new = HostBoard(library, imu_errors=ImuErrors(), eeprom=old.eeprom)
    new.set_receiver(False)
    new.imu.set_fault("unplugged")
    old.reset("power")
    said = []
    for board in (new, old):
        each = Aboard(board)
        each.run_ms(500)
        for letter in ("s", "m", "G", "c", "a"):
            each.send(letter)
        each.run_ms(1000)
        said.append([(one.type, one.payload) for one in each.heard])
        assert each.tap.bad_frames == 0
    assert len(said[0]) > 100
    assert said[0] == said[1]


def test_boards_of_one_process_share_nothing(library):
    boards = [Aboard(HostBoard(library, imu_errors=ImuErrors())) for _ in range(3)]
    for at, each in enumerate(boards):
        each.board.set_stick("ailerons", 1400 + 100 * at)
        each.run_ms(500)
    for at, each in enumerate(boards):
        assert each.board.pulses_us()[0] == pytest.approx(1400 + 100 * at, abs=1)
    boards[0].answers("g", GAINS)
    assert boards[1].answers("G") != [("G", GAINS)]


def test_an_invalid_library_is_refused(tmp_path):
    wrong = tmp_path / "wrong.so"
    wrong.write_bytes(b"no library")
    for path in (tmp_path / "missing.so", wrong, _ctypes.__file__):
        with pytest.raises(RigUnavailableError, match=r"make -C arduino host-library") as refused:
            HostBoard(path, imu_errors=ImuErrors())
        assert str(path) in str(refused.value)
        assert "\n" not in str(refused.value)
