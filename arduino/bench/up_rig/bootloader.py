"""The bootloader optiboot, compiled from the source that Debian's arduino-core-avr ships.

The HEX file beside that source does not fit: compiled with today's defaults it takes 532 bytes of
the 512 below the end of the flash. Two switches reduce it to the 500 of the original.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from up_rig.errors import RigUnavailableError
from up_rig.library import compile_to, library_path

SOURCE = Path("/usr/share/arduino/hardware/arduino/avr/bootloaders/optiboot/optiboot.c")
START, VERSION = 0x7E00, 0x7FFE
_FLAGS = (
    "-w -Os -fno-split-wide-types -mrelax -fno-move-loop-invariants -fno-tree-scev-cprop "
    "-mmcu=atmega328p -DF_CPU=16000000L -DLED_START_FLASHES=3 -DBAUD_RATE=115200 "
    f"-Wl,--section-start=.text={START:#x} -Wl,--section-start=.version={VERSION:#x} "
    "-Wl,--relax -nostartfiles -nostdlib"
).split()


def build_optiboot() -> Path:
    """Return the ELF file of optiboot, compiled once; raises RigUnavailableError."""
    path = library_path().with_name("optiboot.elf")
    if path.is_file() and path.stat().st_mtime >= Path(__file__).stat().st_mtime:
        return path
    compiler = shutil.which("avr-gcc")
    if compiler is None or not SOURCE.exists():
        raise RigUnavailableError("optiboot needs the Debian packages gcc-avr and arduino-core-avr")
    compile_to(path, [compiler, *_FLAGS, f"-I{SOURCE.parent}", str(SOURCE)], "optiboot")
    return path
