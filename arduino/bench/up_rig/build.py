"""Builds the firmware by its Makefile, one process at a time."""

from __future__ import annotations

import contextlib
import fcntl
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from up_rig.errors import RigError, RigUnavailableError
from up_rig.library import SOURCES

ARDUINO = SOURCES.parents[2]
CORE = Path("/usr/share/arduino/hardware/arduino/avr/cores/arduino/Arduino.h")
AVR_LIBC = Path("/usr/lib/avr/include/avr/io.h")
PACKAGES = "make gcc-avr avr-libc arduino-core-avr"
MAX_BUILD_S = 900.0
NO_SOURCES = f"the firmware's sources are not here: there is no {ARDUINO / 'raspilot'}"


class BuildError(RigError):
    """The firmware does not compile; the text is make's output."""

    def __init__(self, text: str, code: str = "make_failed") -> None:
        super().__init__(text, code)


def has_sources() -> bool:
    """Return whether this is a source tree: an installed rig has no firmware with it."""
    return (ARDUINO / "raspilot" / "raspilot.ino").is_file()


def missing_toolchain() -> str | None:
    """Return one sentence when the firmware cannot be built here; None when it can."""
    if not has_sources():
        return NO_SOURCES
    programs = [name for name in ("make", "avr-g++", "avr-gcc") if shutil.which(name) is None]
    files = [str(path) for path in (CORE, AVR_LIBC) if not path.exists()]
    if not programs and not files:
        return None
    lacking = ", ".join(programs + files)
    return f"building the firmware needs {lacking} (Debian packages {PACKAGES})"


def make(*arguments: str, timeout_s: float = MAX_BUILD_S, lock_name: str = ".lock") -> str:
    """Run make in ``arduino/`` and return its output.

    Of several processes one builds, the others wait, also for compilers that outlive a killed
    builder: they inherit the lock. ``lock_name``: another one for builds that share no file with
    the firmware. Raises ``BuildError``, and ``RigUnavailableError`` without make, without the
    sources, and where nothing can be written.
    """
    program = shutil.which("make")
    if program is None:
        raise RigUnavailableError("building needs make (Debian package make)")
    if not has_sources():
        raise RigUnavailableError(NO_SOURCES)
    with _lock(lock_name) as lock:
        try:
            done = subprocess.run(
                [program, "-C", str(ARDUINO), *arguments],
                capture_output=True,
                text=True,
                timeout=timeout_s,
                check=False,
                pass_fds=(lock,),
            )
        except subprocess.TimeoutExpired as error:
            raise BuildError(f"make needs more than {timeout_s:g} s", "timeout") from error
    said = done.stdout + done.stderr
    if done.returncode:
        raise BuildError(said)
    return said


@contextlib.contextmanager
def _lock(name: str) -> Iterator[int]:
    build = ARDUINO / "build"
    try:
        build.mkdir(exist_ok=True)
        lock = (build / name).open("w")
    except OSError as error:
        raise RigUnavailableError(f"{build} cannot be written: {error.strerror}") from error
    with lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield lock.fileno()


def build_firmware(*options: str) -> Path:
    """Return the ELF file of the firmware, built if need be; options such as ``BAUD=9600``.

    Raises ``BuildError``, and ``RigUnavailableError`` without the toolchain.
    """
    lacking = missing_toolchain()
    if lacking is not None:
        raise RigUnavailableError(lacking)
    chosen = dict(option.split("=") for option in options)
    folder = "build" + "".join(f"-{chosen[name]}" for name in ("BAUD", "BOARD") if name in chosen)
    make(*options, f"{folder}/raspilot.elf")
    return ARDUINO / folder / "raspilot.elf"
