"""Chooses the board: the firmware if it can be built, otherwise a substitute."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from up_rig import FirmwareError, RigUnavailableError
from up_rig.build import ARDUINO, BuildError, build_firmware, build_host_library, has_sources
from up_rig.library import load_library
from up_simulator.firmware.board import BoardKind, FirmwareBoard
from up_simulator.firmware.direct_board import DirectBoard
from up_simulator.firmware.host_board import HostBoard
from up_simulator.firmware.imu_errors import ImuErrors
from up_simulator.firmware.rig_board import RigBoard
from up_simulator.harness.user_log import Log, no_log

HOST_LIBRARY = ARDUINO / "build" / "libraspilot.so"
FIRMWARE = ARDUINO / "build" / "raspilot.elf"
_NOT_REBUILT = "is an earlier build, not rebuilt"


class BoardUnavailableError(Exception):
    """The board is unavailable here: the message is one sentence for the user."""


@dataclass(frozen=True, slots=True)
class Program:
    """A built program, and how a board with it is made."""

    path: Path
    make: Callable[..., FirmwareBoard]

    def board(
        self, *, seed: int = 1, imu_errors: ImuErrors | None = None, eeprom: bytes = b""
    ) -> FirmwareBoard:
        """Return a freshly powered board; raises ``BoardUnavailableError``."""
        errors = imu_errors or ImuErrors()
        try:
            return self.make(self.path, seed=seed, imu_errors=errors, eeprom=eeprom)
        except (RigUnavailableError, FirmwareError) as error:
            raise BoardUnavailableError(str(error)) from error


def choose_board(
    kind: BoardKind = "auto",
    *,
    seed: int = 1,
    imu_errors: ImuErrors | None = None,
    eeprom: bytes = b"",
    elf: Path | None = None,
    log: Log = no_log,
) -> FirmwareBoard:
    """Return a freshly powered board.

    ``auto`` is the firmware on the simulated chip if the AVR tools and simavr are installed,
    otherwise the same sources built for this computer, which ``log`` reports in one sentence.
    ``elf`` is a built firmware that replaces the project's own. Raises ``BoardUnavailableError``.
    """
    if kind == "direct":
        return DirectBoard(seed=seed, imu_errors=imu_errors)
    program = aboard("firmware" if elf else kind, log, elf)
    return program.board(seed=seed, imu_errors=imu_errors, eeprom=eeprom)


def aboard(kind: BoardKind, log: Log = no_log, elf: Path | None = None) -> Program:
    """Return the program for a kind of board, built if need be; raises as ``choose_board``.

    If the build is impossible, an earlier build is used, which ``log`` reports.
    """
    if kind == "host":
        return _host_program(log)
    try:
        load_library()
        return Program(elf or _firmware(log), RigBoard)
    except BuildError as error:
        raise BoardUnavailableError(f"the firmware does not compile: {_reason(error)}") from error
    except RigUnavailableError as error:
        if kind == "firmware":
            raise BoardUnavailableError(str(error)) from error
        program = _host_program(log)
        text = f"the firmware's sources, built for this computer, fly instead: {error}"
        log(text, code="board_substituted", reason=str(error))
        return program


def _firmware(log: Log) -> Path:
    try:
        return build_firmware()
    except RigUnavailableError as error:
        if not _is_ready(FIRMWARE):
            raise
        log(f"the firmware {_NOT_REBUILT}: {error}", code="board_outdated", reason=str(error))
        return FIRMWARE


def _host_program(log: Log) -> Program:
    library = HOST_LIBRARY
    try:
        library = build_host_library()
    except (RigUnavailableError, BuildError) as error:
        reason = _reason(error)
        if isinstance(error, BuildError) and "needs a C++ compiler" not in reason:
            raise BoardUnavailableError(
                f"the firmware's sources do not compile for this computer: {reason}"
            ) from error
        reason = reason[0].lower() + reason[1:]
        if not _is_ready(HOST_LIBRARY):
            raise BoardUnavailableError(reason) from error
        text = f"the firmware for this computer {_NOT_REBUILT}: {reason}"
        log(text, code="board_outdated", reason=reason)
    return Program(library, HostBoard)


def _is_ready(program: Path) -> bool:
    """Return whether a program is there, and no source is newer."""
    if not has_sources() or not program.is_file():
        return False
    folders = (ARDUINO / "raspilot", ARDUINO / "host" / "library")
    sources = (path for folder in folders for path in folder.rglob("*") if path.is_file())
    built_s = program.stat().st_mtime
    return all(path.stat().st_mtime <= built_s for path in sources)


def _reason(error: Exception) -> str:
    """Return the most informative line of make's output: the first error, or the last line."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    errors = [line for line in lines if "error:" in line or "needs" in line]
    return (errors or lines[-1:] or ["make printed nothing"])[0]
