"""Puts an airframe's settings into a board's EEPROM, over its serial line as the Pi does."""

from __future__ import annotations

import contextlib
import hashlib
import json
import struct
from collections.abc import Mapping
from typing import Any

from up.commands.board_status import refusal_text
from up.commands.gains import AXES, MAX_GAIN
from up.errors import UserError
from up.flight_controller.profile_wire import flat, pack_profile, read_profile
from up_rig.imu import motion_at
from up_simulator.firmware.board import BoardKind, FirmwareBoard
from up_simulator.firmware.build import aboard
from up_simulator.firmware.kept import cache_path, keep
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.harness.user_log import Log, no_log

STEP_US = 10_000.0
BOOT_US = 1_500_000.0
ANSWER_STEPS = 50
QUIET_STEPS = 30
"""An EEPROM unchanged for this time is complete: a byte takes 3.4 ms."""
WRITE_STEPS = 600
_ANSWERS = {"c": "C", "G": "G"}
_GAINS = struct.Struct(">18f")
_LOOPS = ("rate", "stabilize")
_GAIN_KEYS = [f"{loop}.{axis}.{term}" for loop in _LOOPS for axis in AXES for term in "pid"]


class SettingsError(ValueError):
    """A setting cannot be put on the wire: one sentence that names it, and its ``code``."""

    # The default lets a process pool copy the error.
    def __init__(self, message: str, code: str = "invalid_settings") -> None:
        super().__init__(message)
        self.code = code


class PreparationError(UserError):
    """The board does not take its settings."""


def profile_bytes(settings: Mapping[str, Any], held: bytes) -> bytes:
    """Return the payload of ``C``: what a board holds, with the settings that are not null.

    Raises ``SettingsError``.
    """
    profile = read_profile(held)
    for key, value in flat(settings):
        if key not in profile:
            raise SettingsError(f"unknown key of a profile: {key}", "unknown_profile_key")
        profile[key] = value
    try:
        return pack_profile(profile)
    except (ValueError, TypeError, struct.error) as error:
        raise SettingsError(str(error), "invalid_profile") from None


def gains_bytes(settings: Mapping[str, Any], held: bytes) -> bytes:
    """Return the payload of ``g``: what a board holds, with the gains that are given.

    Raises ``SettingsError``.
    """
    values = list(_GAINS.unpack(held))
    for key, value in flat(settings):
        if key == "units":
            continue
        if key not in _GAIN_KEYS:
            raise SettingsError(f"unknown gain {key}", "unknown_gain")
        if not isinstance(value, int | float) or not 0.0 <= value <= MAX_GAIN:
            text = f"{key} must be 0 to {MAX_GAIN:g}, not {value!r}"
            raise SettingsError(text, "gain_out_of_range")
        values[_GAIN_KEYS.index(key)] = value
    return _GAINS.pack(*values)


def cached_eeprom(
    kind: BoardKind,
    profile: Mapping[str, Any],
    gains: Mapping[str, Any],
    log: Log = no_log,
    *,
    divider: float = 0.0,
) -> bytes:
    """Return the EEPROM of a board of this kind that holds an airframe's profile and gains.

    ``divider`` is that of its flight battery, for which the board is calibrated; 0: none.

    The result is computed once for each firmware and each set of values and cached beside the
    build. Raises ``BoardUnavailableError``, ``BoardCrashedError``, ``SettingsError`` and
    ``PreparationError``.
    """
    if kind == "direct":
        return b""
    program = aboard(kind, log)
    values = json.dumps([profile, gains, divider], sort_keys=True, default=str).encode()
    name = hashlib.sha256(program.path.read_bytes() + values).hexdigest()[:32]
    kept = cache_path("eeprom", f"{name}.bin")
    if kept.is_file():
        return kept.read_bytes()
    eeprom = prepare_eeprom(program.board(), profile, gains, divider)
    # Without a writable folder the work is repeated the next time.
    with contextlib.suppress(OSError):
        keep(kept, eeprom)
    return eeprom


def prepare_eeprom(
    board: FirmwareBoard,
    profile: Mapping[str, Any],
    gains: Mapping[str, Any],
    divider: float = 0.0,
) -> bytes:
    """Boot a board, write profile and gains, and return its EEPROM afterwards.

    ``profile`` is shaped like airframe.yml, ``gains`` like pids.yml; for null or missing values
    the board keeps its own. All are read back after another power-on. The board ends disarmed, at
    rest and level. Raises ``PreparationError``, ``SettingsError`` and ``BoardCrashedError``.
    """
    talk = _Talk(board)
    board.set_motion(motion_at(0.0, 0.0))
    board.set_a7(1.0)
    board.run_us(BOOT_US)
    if divider:
        # Before the profile: without a motor a board with a receiver is in flight.
        voltage_mv = round(1000 / divider)
        talk.command("V", voltage_mv.to_bytes(2, "big"), "the flight battery's voltage")
    wanted_profile = profile_bytes(profile, talk.ask("c"))
    wanted_gains = gains_bytes(gains, talk.ask("G"))
    if wanted_profile != talk.ask("c"):
        talk.command("C", wanted_profile, "the profile of the airframe")
    if wanted_gains != talk.ask("G"):
        talk.command("g", wanted_gains, "the gains")
    _wait_for_eeprom(board)
    board.reset("power")
    board.run_us(BOOT_US)
    talk = _Talk(board)
    if talk.ask("c") != wanted_profile or talk.ask("G") != wanted_gains:
        text = "the board has other settings after a power-on than it was given"
        raise PreparationError(text, "not_kept")
    return board.eeprom


class _Talk:
    """One Command at a time, each with its answer."""

    def __init__(self, board: FirmwareBoard) -> None:
        self._board = board
        self._tap = LineMonitor()

    def command(self, letter: str, payload: bytes, what: str) -> None:
        answer = self._exchange(letter, payload, "K")
        if answer is None:
            raise PreparationError(f"the board does not answer to {what}", "no_answer")
        if answer[0] == "!":
            text = f"the board refuses {what}: {refusal_text(answer[1][2])}"
            raise PreparationError(text, "refused")

    def ask(self, letter: str) -> bytes:
        answer = self._exchange(letter, b"", _ANSWERS[letter])
        if answer is None or answer[0] == "!":
            raise PreparationError(f"the board does not answer to {letter}", "no_answer")
        return answer[1]

    def _exchange(self, letter: str, payload: bytes, expected: str) -> tuple[str, bytes] | None:
        self._tap.take_answers()
        self._board.write(self._tap.command_bytes(letter, payload))
        for _ in range(ANSWER_STEPS):
            self._board.run_us(STEP_US)
            self._tap.feed(self._board.read(), self._board.now_us / 1e6)
            for each in self._tap.take_answers():
                is_mine = each.type not in "K!" or each.payload[0] == ord(letter)
                if each.type in (expected, "!") and is_mine:
                    return each.type, each.payload
        return None


def _wait_for_eeprom(board: FirmwareBoard) -> None:
    held, quiet = board.eeprom, 0
    for _ in range(WRITE_STEPS):
        board.run_us(STEP_US)
        fresh = board.eeprom
        quiet, held = (quiet + 1 if fresh == held else 0), fresh
        if quiet >= QUIET_STEPS:
            return
    raise PreparationError("the board writes its EEPROM without end", "endless_write")
