"""The board aboard: its firmware, with the airframe's settings in its EEPROM."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import yaml

from up_rig.build import ARDUINO
from up_simulator.aircraft import Airframe
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.firmware.build import BoardUnavailableError, choose_board
from up_simulator.firmware.imu_errors import drawn_errors
from up_simulator.firmware.preparation import prepared_eeprom
from up_simulator.firmware.settings_wire import SettingsError


def board_aboard(
    options: argparse.Namespace, airframe: Airframe, say: Callable[[str], None]
) -> FirmwareBoard:
    """Return the board that the options select.

    ``auto`` is the firmware on its chip, or, without the AVR tools, the same sources built for
    this computer, which ``say`` reports in one sentence. Raises ``BoardUnavailableError``.
    """
    if not (ARDUINO / "build" / "raspilot.elf").exists() and options.elf is None:
        say("building the firmware: that takes a minute, the first time")
    errors = drawn_errors(
        options.seed,
        vibration_deg_s=airframe.imu.vibration_deg_s,
        vibration_m_s2=airframe.imu.vibration_m_s2,
    )
    try:
        eeprom = _eeprom(options, airframe, say)
        board = choose_board(
            options.board,
            seed=options.seed,
            imu_errors=errors,
            eeprom=eeprom,
            elf=options.elf,
            say=say,
        )
    except BoardUnavailableError as error:
        if options.elf is not None or options.board == "auto":
            raise
        advice = "leave --board out to fly the best board that works here"
        raise BoardUnavailableError(f"--board {options.board}: {error}; or {advice}") from error
    say(f"aboard: {board.title}")
    return board


def _eeprom(options: argparse.Namespace, airframe: Airframe, say: Callable[[str], None]) -> bytes:
    gains = airframe.gains
    if options.gains is not None:
        try:
            return prepared_eeprom(options.board, airframe.profile, _read(options.gains))
        except (OSError, SettingsError, yaml.YAMLError) as error:
            line = " ".join(str(error).split())
            say(f"{options.gains}: {line}: the airframe's own gains are aboard")
    return prepared_eeprom(options.board, airframe.profile, gains)


def _read(path: Path) -> Mapping[str, Any]:
    found = yaml.safe_load(path.read_text(encoding="utf-8"))
    if not isinstance(found, dict):
        raise SettingsError("it holds no gains")
    return found
