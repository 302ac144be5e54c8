"""Loads the host build of the firmware, a copy for each board: it has global variables."""

from __future__ import annotations

import _ctypes
import ctypes
import os
import shutil
import tempfile
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

from up_rig import RigUnavailableError

VERSION = 2
EEPROM_SIZE = 1024
SAMPLE_NUMBERS = 7
_BUILD = "make -C arduino host-library builds it"


class View(ctypes.Structure):
    """Data shared by the library and its caller; ``host_board_view`` of host_board.h."""

    _fields_ = [
        ("now_us", ctypes.c_double),
        ("width_us", ctypes.c_double * 4),
        ("ended_us", ctypes.c_double * 4),
        ("sample_us", ctypes.c_double),
        ("imu_registers", ctypes.c_uint8 * 128),
        ("sample", ctypes.c_int16 * SAMPLE_NUMBERS),
        ("eeprom", ctypes.c_uint8 * EEPROM_SIZE),
    ]


class HostLibrary:
    """A private copy of the library, with the functions of host_board.h without their prefix.

    It is unloaded with the last reference to it. Raises ``RigUnavailableError``.
    """

    def __init__(self, path: Path) -> None:
        library = _load_copy(path)
        weakref.finalize(self, _ctypes.dlclose, library._handle)
        _check(library, path)
        u8, u32, number = ctypes.c_uint8, ctypes.c_uint32, ctypes.c_double
        text = ctypes.c_char_p

        def function(name: str, result: object, *arguments: object) -> Callable[..., Any]:
            found = getattr(library, f"host_board_{name}")
            found.restype, found.argtypes = result, list(arguments)
            return cast(Callable[..., Any], found)

        self.begin = function("begin", None, text, u32, u32, number)
        self.run = function("run", ctypes.c_int, number)
        self.reset = function("reset", None, u8)
        self.set_stick = function("set_stick", None, u8, number)
        self.set_receiver = function("set_receiver", None, ctypes.c_int)
        self.set_channel = function("set_channel", None, u8, ctypes.c_int)
        self.write = function("write", None, text, u32)
        self.read = function("read", u32, text, u32)
        self.set_a7 = function("set_a7", None, number)
        self.set_imu_fault = function("set_imu_fault", None, u8)
        self.view: View = function("get_view", ctypes.POINTER(View))().contents


def _load_copy(path: Path) -> ctypes.CDLL:
    # The loader loads a file only once: each board gets a separate copy.
    try:
        descriptor, name = tempfile.mkstemp(prefix="firmware-", suffix=".so")
        os.close(descriptor)
        try:
            shutil.copyfile(path, name)
            return ctypes.CDLL(name)
        finally:
            Path(name).unlink()
    except OSError as error:
        raise RigUnavailableError(
            f"the host build of the firmware {path} cannot be loaded ({error}): {_BUILD}"
        ) from error


def _check(library: ctypes.CDLL, path: Path) -> None:
    try:
        version = library.host_board_version()
    except AttributeError:
        version = None
    if version != VERSION:
        raise RigUnavailableError(f"{path} is not a host build of this firmware: {_BUILD} again")
