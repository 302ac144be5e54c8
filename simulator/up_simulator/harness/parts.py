"""The parts that the options of ``up-sim start`` select: flight and board."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import yaml

from up_simulator.aircraft import Airframe, FlightDynamics, Start, Weather
from up_simulator.aircraft.model import MODEL_TITLES
from up_simulator.firmware.board import FirmwareBoard
from up_simulator.firmware.build import FIRMWARE, BoardUnavailableError, choose_board
from up_simulator.firmware.imu_errors import drawn_errors
from up_simulator.firmware.preparation import SettingsError, cached_eeprom
from up_simulator.harness.user_log import Log


def make_flight(options: argparse.Namespace, airframe: Airframe, log: Log) -> FlightDynamics:
    """Return the flight that the options select; ``log`` gets the choice.

    Raises ``FlightUnavailableError``.
    """
    weather = Weather(wind_m_s=options.wind, turbulence=options.turbulence)
    flight = FlightDynamics(
        airframe, Start(), weather, options.seed, may_land=True, model=options.model
    )
    text = f"flying {airframe.title} by {MODEL_TITLES[flight.model]}: wind {options.wind:g} m/s"
    log(f"{text}, turbulence {options.turbulence}", code="flight_selected", source=flight.model)
    return flight


def make_board(options: argparse.Namespace, airframe: Airframe, log: Log) -> FirmwareBoard:
    """Return the board that the options select.

    ``auto`` is the firmware on its chip, or, without the AVR tools, the same sources built for
    this computer, which ``log`` reports in one sentence. Raises ``BoardUnavailableError``.
    """
    if not FIRMWARE.exists() and options.elf is None:
        log("building the firmware, which takes a minute the first time", code="building")
    errors = drawn_errors(
        options.seed,
        vibration_deg_s=airframe.imu.vibration_deg_s,
        vibration_m_s2=airframe.imu.vibration_m_s2,
    )
    try:
        eeprom = _eeprom(options, airframe, log)
        board = choose_board(
            options.board,
            seed=options.seed,
            imu_errors=errors,
            eeprom=eeprom,
            elf=options.elf,
            log=log,
        )
    except BoardUnavailableError as error:
        if options.elf is not None or options.board == "auto":
            raise
        advice = "leave --board out to fly the best board that works here"
        raise BoardUnavailableError(f"--board {options.board}: {error}; or {advice}") from error
    log(f"aboard: {board.title}", code="board_selected", board=board.title)
    return board


def _eeprom(options: argparse.Namespace, airframe: Airframe, log: Log) -> bytes:
    prepared = partial(
        cached_eeprom, options.board, airframe.profile, divider=airframe.battery.divider
    )
    if options.gains is not None:
        try:
            return prepared(_read(options.gains))
        except (OSError, SettingsError, yaml.YAMLError) as error:
            line = " ".join(str(error).split())
            text = f"{options.gains}: {line}: the airframe's own gains are used"
            log(text, code="gains_rejected", file=str(options.gains))
    return prepared(airframe.gains)


def _read(path: Path) -> Mapping[str, Any]:
    found = yaml.safe_load(path.read_text(encoding="utf-8"))
    if not isinstance(found, dict):
        raise SettingsError("not a mapping of gains")
    return found
