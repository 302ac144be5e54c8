"""Builds the small programs of tests/fixtures/arduino for the chip."""

import subprocess
from pathlib import Path

import pytest

from tests.support.tools import need_tool, unavailable
from up_rig import Rig, RigUnavailableError

FIXTURES = Path(__file__).parents[2] / "fixtures" / "arduino"


def build(name, folder, *options):
    """Compile one fixture and return the ELF file's path."""
    compiler = need_tool("avr-gcc", "gcc-avr")
    elf = Path(folder) / f"{name}.elf"
    command = [compiler, "-mmcu=atmega328p", "-DF_CPU=16000000L", "-Os", "-std=gnu11"]
    command += ["-Wall", "-Wextra", "-Werror", "-Wno-unused", *options, "-o", str(elf)]
    result = subprocess.run(
        [*command, str(FIXTURES / f"{name}.c")], capture_output=True, text=True, check=False
    )
    if result.returncode:
        pytest.fail(f"{name}.c does not compile:\n{result.stderr}")
    return elf


def make_rig(elf, **options):
    """Return a rig with a program; skips where simavr is missing."""
    try:
        return Rig(elf, **options)
    except RigUnavailableError as error:
        unavailable(str(error))


def rig_with(name, folder, **options):
    """Compile one fixture and put it on the bench."""
    return make_rig(build(name, folder), **options)
