"""Chooses what is aboard: the firmware where it can be built, else what can be."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from pathlib import Path

from up_rig import FirmwareError, RigUnavailableError
from up_rig.build import ARDUINO, BuildError, build_firmware, make
from up_simulator.firmware.board import BoardKind, FirmwareBoard
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.rig_board import RigBoard

HOST_LIBRARY = ARDUINO / "build" / "libraspilot.so"


class BoardUnavailableError(Exception):
    """No such board can be had here: the message is one sentence for the user."""


def choose_board(
    kind: BoardKind = "auto",
    *,
    seed: int = 1,
    imu_errors: ImuErrors | None = None,
    eeprom: bytes = b"",
    elf: Path | None = None,
    say: Callable[[str], None] = lambda _text: None,
) -> FirmwareBoard:
    """Return a board that has just got its power.

    ``auto`` is the firmware on the simulated chip where the AVR tools and simavr are, else the same
    sources built for this computer, which ``say`` is told in one sentence. ``elf`` is a firmware
    that is built already. Raises ``BoardUnavailableError``.
    """
    errors = imu_errors or ImuErrors()
    if kind == "direct":
        return DirectBoard(seed=seed, imu_errors=errors)
    if kind == "host":
        return _host_board(seed, errors, eeprom)
    try:
        return RigBoard(elf or firmware(), seed=seed, imu_errors=errors, eeprom=eeprom)
    except (RigUnavailableError, FirmwareError) as error:
        if kind == "firmware":
            raise BoardUnavailableError(str(error)) from error
        say(f"the sources of the firmware, built for this computer, fly instead: {error}")
    return _host_board(seed, errors, eeprom)


def firmware() -> Path:
    """Return the ELF file, built if need be.

    Raises ``RigUnavailableError`` without the tools and ``BoardUnavailableError`` where the
    sources do not compile.
    """
    try:
        return build_firmware()
    except BuildError as error:
        raise BoardUnavailableError(f"the firmware does not compile: {_reason(error)}") from error


def _host_board(seed: int, errors: ImuErrors, eeprom: bytes) -> FirmwareBoard:
    try:
        make("host-library")
    except RigUnavailableError as error:
        raise BoardUnavailableError(str(error)) from error
    except BuildError as error:
        raise BoardUnavailableError(
            f"the firmware's sources do not compile for this computer: {_reason(error)}"
        ) from error
    module = importlib.import_module("up_simulator.firmware.host_board")
    board: FirmwareBoard = module.HostBoard(
        HOST_LIBRARY, seed=seed, imu_errors=errors, eeprom=eeprom
    )
    return board


def _reason(error: BuildError) -> str:
    """Return the line of make's output that says most: the first error, or the last line."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    errors = [line for line in lines if "error:" in line or "needs" in line]
    return (errors or lines[-1:] or ["make said nothing"])[0]
