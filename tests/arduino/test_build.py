"""The firmware builds in every variant, fits, and its portable part passes its own tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.firmware import ARDUINO, BuildError, build_firmware, make, need_toolchain
from tests.support.tools import need_tool, unavailable
from up_rig.elf import read_firmware

OPTIBOOT_ROOM = 32256
CLASSIC_NANO_ROOM = 30720
RAM = 2048
MIN_STACK = 600
MAX_FLASH = 27_000
MAX_RAM = 1_400
FUZZ = Path(__file__).parents[2] / "arduino" / "host" / "fuzz"


@pytest.mark.parametrize("options", [(), ("BAUD=9600",), ("BOARD=prototype",)])
def test_every_variant_fits_the_board(options):
    firmware = read_firmware(build_firmware(*options))
    assert firmware.size <= CLASSIC_NANO_ROOM < OPTIBOOT_ROOM
    assert RAM - (firmware.symbols["_end"].address - 0x100) >= MIN_STACK


def test_the_default_variant_grows_no_further():
    firmware = read_firmware(build_firmware())
    assert firmware.size <= MAX_FLASH
    assert firmware.symbols["_end"].address - 0x100 <= MAX_RAM


def test_it_fits_behind_optiboot_as_the_arduino_ide_compiles_it():
    need_toolchain()
    make("SMALLER=", "FOLDER=build-ide", "build-ide/raspilot.elf")
    assert read_firmware(ARDUINO / "build-ide" / "raspilot.elf").size <= OPTIBOOT_ROOM


def test_there_is_no_heap():
    names = read_firmware(build_firmware()).symbols
    assert not {"malloc", "free", "realloc", "_Znwj", "_ZdlPv"} & set(names)


def test_a_wrong_option_is_refused():
    need_toolchain()
    with pytest.raises(BuildError, match="'mega'"):
        make("BOARD=mega")


def make_or_skip(target):
    """Return what make printed; without what it needs, skip as for any missing tool.

    It has its own lock, so that tests with the firmware need not wait for these minutes.
    """
    try:
        return make(target, lock_name=f".{target}.lock")
    except BuildError as failure:
        if "apt-get install" in str(failure):
            lines = str(failure).splitlines()
            unavailable(next(line for line in lines if "apt-get install" in line))
        raise


def test_the_portable_part_passes_its_tests_on_this_computer():
    need_tool("g++")
    assert "test cases:" in make_or_skip("host-test")


def test_the_serial_line_takes_every_kept_input_of_the_fuzzer():
    need_tool("clang++", "clang")
    kept = [each for name in ("corpus", "flying_corpus") for each in (FUZZ / name).iterdir()]
    assert make_or_skip("fuzz-corpus").count("\nExecuted ") == len(kept) > 40
