"""Builds the firmware by its Makefile, one process at a time.

An installed rig carries the built firmware, which is used unchanged, and the sources for other
builds, which are made in a copy in the user's cache.
"""

from __future__ import annotations

import contextlib
import fcntl
import functools
import hashlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from up_rig.errors import RigError, RigUnavailableError
from up_rig.library import SOURCES, cache_folder

SHIPPED = Path(__file__).with_name("arduino")
"""In an installed rig: the sources, and ``release/raspilot.elf``."""


def _folder() -> Path:
    """Return the folder ``arduino`` of the source tree, or where an installed rig has its copy."""
    if not SHIPPED.is_dir():
        return SOURCES.parents[2]
    files = sorted(each for each in SHIPPED.rglob("*") if each.is_file())
    digest = hashlib.sha256(b"\0".join(each.read_bytes() for each in files)).hexdigest()
    return cache_folder() / f"arduino-{digest[:16]}"


ARDUINO = _folder()
CORE = Path("/usr/share/arduino/hardware/arduino/avr/cores/arduino/Arduino.h")
AVR_LIBC = Path("/usr/lib/avr/include/avr/io.h")
PACKAGES = "make gcc-avr avr-libc arduino-core-avr"
MAX_BUILD_S = 900.0
NO_SOURCES = f"the firmware's sources are not here: there is no {ARDUINO / 'raspilot'}"
SHIPPED_FIRMWARE = SHIPPED / "release" / "raspilot.elf"


class BuildError(RigError):
    """The firmware does not compile; the text is make's output."""

    def __init__(self, text: str, code: str = "make_failed") -> None:
        super().__init__(text, code)


def has_sources() -> bool:
    """Return whether the firmware's sources are here; an installed rig makes its copy of them."""
    if SHIPPED.is_dir() and not ARDUINO.exists():
        # Of several processes the first one's copy stays.
        with contextlib.suppress(OSError):
            ARDUINO.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(dir=ARDUINO.parent) as folder:
                shutil.copytree(SHIPPED, Path(folder, "arduino")).rename(ARDUINO)
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


@functools.cache
def build_firmware(*options: str) -> Path:
    """Return the ELF file of the firmware, built if need be; options such as ``BAUD=9600``.

    An installed rig has it built already, without options. A process looks at the sources once: all
    its flights have the same firmware. Raises ``BuildError``, and ``RigUnavailableError`` without
    the toolchain.
    """
    if not options and SHIPPED_FIRMWARE.is_file():
        return SHIPPED_FIRMWARE
    lacking = missing_toolchain()
    if lacking is not None:
        raise RigUnavailableError(lacking)
    chosen = dict(option.split("=") for option in options)
    folder = "build" + "".join(f"-{chosen[name]}" for name in ("BAUD", "BOARD") if name in chosen)
    make(*options, f"{folder}/raspilot.elf")
    return ARDUINO / folder / "raspilot.elf"


@functools.cache
def build_host_library() -> Path:
    """Return the firmware built for this computer, as ``build_firmware``; raises as ``make``."""
    make("host-library")
    return ARDUINO / "build" / "libraspilot.so"
