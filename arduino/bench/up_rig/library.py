"""The C part of the rig: built when it is missing or older than its sources, loaded by ctypes."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

from up_rig.errors import RigUnavailableError

SOURCES = Path(__file__).with_name("shim")
HEADER = Path("/usr/include/simavr/sim_avr.h")
FLAGS = ["-std=gnu11", "-O2", "-Wall", "-Wextra", "-fPIC", "-shared"]
NEEDS = "the bench rig needs simavr and gcc (Debian packages gcc, libsimavr-dev and libelf-dev)"

SampleFunction = ctypes.CFUNCTYPE(None, ctypes.c_uint64, ctypes.POINTER(ctypes.c_int16))


class Edge(ctypes.Structure):
    """A pin's change, as the C side records it."""

    _fields_ = [("cycle", ctypes.c_uint64), ("pin", ctypes.c_uint8), ("level", ctypes.c_uint8)]


class Sent(ctypes.Structure):
    """A byte that the chip has sent, with the cycle of the end of its stop bit."""

    _fields_ = [("cycle", ctypes.c_uint64), ("value", ctypes.c_uint8)]


class PinPulse(ctypes.Structure):
    """The cycles at which a pin's newest whole pulse rose and fell; fell is 0 before the first."""

    _fields_ = [("rise", ctypes.c_uint64), ("fall", ctypes.c_uint64)]


class Meter(ctypes.Structure):
    """The measurements of the C side; ``meter_t`` of rig.h."""

    _fields_ = [
        ("interrupt_cycles", ctypes.c_uint64),
        ("counts", ctypes.c_uint64 * 26),
        ("longest_off", ctypes.c_uint32),
        ("longest_off_pc", ctypes.c_uint16),
        ("sleep_cycles", ctypes.c_uint64),
        ("stack_lowest", ctypes.c_uint16),
        ("resets", ctypes.c_uint64 * 4),
    ]


class Handle:
    """One chip of the library, freed with the last part of a rig that knows it."""

    def __init__(self, library: ctypes.CDLL, seed: int) -> None:
        self._library = library
        self._as_parameter_: int | None = library.rig_new(seed & 0xFFFFFFFF)
        if not self._as_parameter_:
            raise RigUnavailableError("simavr does not know the ATmega328P")

    def __del__(self) -> None:
        if self._as_parameter_:
            self._library.rig_free(self._as_parameter_)
            self._as_parameter_ = None


def library_path() -> Path:
    """Return where the built library lies: arduino/build, or for an installed rig a cache."""
    build = SOURCES.parents[2] / "build"
    if (SOURCES.parents[2] / "bench").is_dir() and os.access(SOURCES.parents[2], os.W_OK):
        return build / "librig.so"
    return cache_folder() / "librig.so"


def cache_folder() -> Path:
    """Return the folder for everything that an installed rig builds."""
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "up_rig"


def build_library() -> Path:
    """Compile the C part if that is needed and return its path; raises RigUnavailableError."""
    path = library_path()
    sources = sorted(SOURCES.glob("*.c"))
    newest = max(each.stat().st_mtime for each in SOURCES.glob("*.[ch]"))
    if path.is_file() and path.stat().st_mtime >= newest:
        return path
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None or not HEADER.exists():
        raise RigUnavailableError(NEEDS, "missing_packages")
    compile_to(path, [compiler, *FLAGS, *map(str, sources), "-lsimavr"], "the bench rig")
    return path


def compile_to(path: Path, command: list[str], what: str) -> None:
    """Run a compiler that writes a file; raises RigUnavailableError with its last line.

    Several processes may build in parallel: each writes its own file, the last one stays.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        fresh = Path(folder) / path.name
        done = subprocess.run(
            [*command, "-o", str(fresh)], capture_output=True, text=True, check=False
        )
        if done.returncode:
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            raise RigUnavailableError(f"{what} does not compile: {last}", "does_not_compile")
        fresh.replace(path)


@cache
def load_library() -> ctypes.CDLL:
    """Return the library with its functions declared; raises RigUnavailableError."""
    path = build_library()
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise RigUnavailableError(f"{NEEDS}: {error}") from error
    _declare(library)
    return library


def _declare(library: ctypes.CDLL) -> None:
    u8, u16, u32, u64 = ctypes.c_uint8, ctypes.c_uint16, ctypes.c_uint32, ctypes.c_uint64
    rig, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double
    count = ctypes.POINTER(u64)

    def declare(name: str, result: object, *arguments: object) -> None:
        function: Callable[..., object] = getattr(library, f"rig_{name}")
        function.restype = result  # type: ignore[attr-defined]
        function.argtypes = list(arguments)  # type: ignore[attr-defined]

    declare("new", rig, u32)
    declare("free", None, rig)
    declare("load", None, rig, text, u32, u32)
    declare("measure", None, rig, ctypes.c_bool)
    declare("reset_pc", None, rig, u32)
    declare("preload", None, rig, u32, u16, text, u16)
    declare("start_up", None, rig, u64)
    declare("run", text, rig, u64)
    declare("crash_code", text, rig)
    declare("reset", None, rig, u8)
    declare("cycle", u64, rig)
    declare("data", ctypes.POINTER(u8), rig)
    declare("meter", ctypes.POINTER(Meter), rig)
    declare("clear_measures", None, rig)
    declare("pin_edge", None, rig, u64, u8, u8)
    declare("pin_level", u8, rig, u8)
    declare("edges", ctypes.POINTER(Edge), rig, count)
    declare("sent", ctypes.POINTER(Sent), rig, count)
    declare("pulses", ctypes.POINTER(PinPulse), rig)
    declare("drop_edges", None, rig, ctypes.c_bool)
    declare("clear_edges", None, rig)
    declare("clear_sent", None, rig)
    declare("uart_baud", None, rig, number)
    declare("uart_write", None, rig, text, u32, u8)
    declare("uart_waiting", u32, rig)
    declare("overruns", u64, rig)
    declare("imu_on_sample", None, rig, SampleFunction)
    declare("imu_register", u8, rig, u8)
    declare("imu_identity", None, rig, u8)
    declare("imu_plug", None, rig, ctypes.c_bool)
    declare("imu_fault", None, rig, u8, u32, u32, ctypes.c_bool)
    declare("imu_fault_now", u8, rig)
    declare("imu_samples", u64, rig)
    declare("imu_transfers", u64, rig)
    declare("eeprom", ctypes.POINTER(u8), rig)
    declare("eeprom_writes", u64, rig)
    declare("eeprom_is_writing", ctypes.c_bool, rig)
    declare("watchdog_factor", None, rig, number)
    declare("analog", None, rig, u8, u32)
