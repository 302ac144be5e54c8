"""Builds the firmware once for every test process that wants to fly it."""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
from pathlib import Path

from tests.support.tools import need_tool, unavailable

ROOT = Path(__file__).resolve().parents[2]
ARDUINO = ROOT / "arduino"
CORE = Path("/usr/share/arduino/hardware/arduino/avr/cores/arduino")


def need_toolchain() -> None:
    """Skip the running test without the AVR toolchain, or fail with UP_REQUIRE_TOOLS."""
    need_tool("make")
    need_tool("avr-gcc", "gcc-avr")
    if not CORE.is_dir():
        unavailable("the Arduino core is not installed (Debian package arduino-core-avr)")
    if not Path("/usr/lib/avr/include/avr/io.h").exists():
        unavailable("avr-libc is not installed (Debian package avr-libc)")


def make(*arguments: str, timeout_s: float = 900.0) -> str:
    """Run make in ``arduino/``, one test process at a time; returns what it printed."""
    program = shutil.which("make")
    assert program is not None
    build = ARDUINO / "build"
    build.mkdir(exist_ok=True)
    with (build / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.run(
            [program, "-C", str(ARDUINO), *arguments],
            capture_output=True,
            text=True,
            timeout=timeout_s,
            check=False,
        )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    return said


def build_firmware(*options: str) -> Path:
    """Return the ELF that ``make -C arduino`` builds; options are for example ``BAUD=9600``.

    ``RASPILOT_ELF`` names another build of the default options to be flown instead.
    """
    if not options and "RASPILOT_ELF" in os.environ:
        return Path(os.environ["RASPILOT_ELF"])
    need_toolchain()
    chosen = dict(option.split("=") for option in options)
    folder = "build" + "".join(f"-{chosen[name]}" for name in ("BAUD", "BOARD") if name in chosen)
    make(*options, f"{folder}/raspilot.elf")
    return ARDUINO / folder / "raspilot.elf"
