"""The board's messages, row by row, as Commands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from up.commands.board_schema import DATA, FLIGHT_MODES, RESET_CAUSES, SWITCH_POSITIONS, Flag
from up.commands.board_status import TOPIC as STATUS_TOPIC
from up.commands.flight_state_command import FlightStateCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand
from up.flight_log.origin_text import KEY as ORIGIN
from up_simulator.scenario.log import Value
from up_simulator.scenario.sticks import CHANNELS

Data = dict[str, Any]
Message = tuple[str, Data]
"""A topic, and the data of one message."""


class LogRow:
    """The value of every signal at one time; None if unknown."""

    def __init__(self, values: Mapping[str, Value]) -> None:
        self._values = values
        self.time_s = self.number("time_s") or 0.0

    def number(self, name: str) -> float | None:
        value = self._values.get(name)
        return value if isinstance(value, float) and math.isfinite(value) else None

    def whole(self, name: str) -> int | None:
        value = self.number(name)
        return None if value is None else round(value)

    def flag(self, name: str) -> bool | None:
        value = self.number(name)
        return None if value is None else bool(value)

    def text(self, name: str) -> str | None:
        value = self._values.get(name)
        return value if isinstance(value, str) and value else None

    def known(self) -> Iterator[tuple[str, float | str]]:
        for name, value in self._values.items():
            if math.isfinite(value) if isinstance(value, float) else value:
                yield name, value


BOARD = "arduino (board)"
STATE_S = 1.0
_ANGLES = ("roll", "pitch", "yaw")
_LETTERS = {word: letter for letter, word in FLIGHT_MODES.items()}
_POSITIONS = {word: number for number, word in SWITCH_POSITIONS.items()}
_SIGNALS = [each for each in DATA if each.signal]


class FreshnessDetector:
    """Detects a new datum by its age: that of an old one grows with the time.

    An age that grows by less than this ``share`` of the time is new: transit times vary.
    """

    def __init__(self, share: float = 0.9) -> None:
        self._share = share
        self._age_s = math.inf
        self._time_s = -math.inf

    def is_new(self, age_s: float | None, time_s: float) -> bool:
        """Return whether it is another datum than at the last call."""
        before_s, self._age_s = self._age_s, math.inf if age_s is None else age_s
        passed_s, self._time_s = time_s - self._time_s, time_s
        return age_s is not None and age_s < before_s + self._share * passed_s


class BoardTopics:
    """The board's messages at their times: a silent board leaves a gap.

    Without a Raspberry Pi aboard the board receives only from a listener: pi_heard is cleared.
    """

    def __init__(self, has_raspilot: bool) -> None:
        self._has_raspilot = has_raspilot
        self._orientation = FreshnessDetector()
        self._status = FreshnessDetector()
        self._state: Data = {}
        self._state_due_s = -math.inf

    def messages(self, row: LogRow) -> Iterator[Message]:
        if self._orientation.is_new(row.number("board.orientation_age_s"), row.time_s):
            data: Data = {angle: row.number(f"board.{angle}_deg") for angle in _ANGLES}
            data |= {f"{each}_rate": row.number(f"board.{each}_rate_deg_s") for each in _ANGLES}
            yield OrientationCommand.NAME, {**data, ORIGIN: BOARD}
        if (inputs := _pulses(row, "stick", CHANNELS)) is not None:
            valid = 0 if row.flag("board.receiver_valid") is False else ALL_VALID
            yield RXCommand.NAME, {**inputs, "valid": valid, ORIGIN: BOARD}
        if (outputs := _pulses(row, "servo", CHANNELS[:4])) is not None:
            yield ServoCommand.NAME, {**outputs, ORIGIN: BOARD}
        yield from self._flight_state(row)
        if self._status.is_new(row.number("board.status_age_s"), row.time_s):
            yield STATUS_TOPIC, {**self._status_data(row), ORIGIN: BOARD}

    def _flight_state(self, row: LogRow) -> Iterator[Message]:
        mode = row.text("board.mode")
        if mode is None:
            return
        state: Data = {"flight_mode": mode}
        state |= {name: row.flag(f"board.{name}") for name in ("armed", "auto", "failsafe")}
        if state != self._state or row.time_s >= self._state_due_s:
            self._state, self._state_due_s = state, row.time_s + STATE_S
            yield FlightStateCommand.NAME, {**state, ORIGIN: BOARD}

    def _status_data(self, row: LogRow) -> Data:
        """Return its status, without the vetoes, which the log has no signal for."""
        causes = (row.text("board.reset_cause") or "").split()
        bits = {
            "flags": 0,
            "reset_cause": sum(1 << bit for bit, word in RESET_CAUSES.items() if word in causes),
        }
        for each in _SIGNALS:
            if each.bit is not None and row.flag(f"board.{each.signal}"):
                bits[each.field] |= 1 << each.bit
        if not self._has_raspilot:
            bits["flags"] &= ~Flag.PI_RECEIVED
        data: Data = {
            "mode": ord(_LETTERS.get(row.text("board.mode") or "", "\0")),
            "switch": _POSITIONS.get(row.text("board.switch") or ""),
            **bits,
        }
        numbers = (each for each in _SIGNALS if each.bit is None)
        return data | {each.name: row.whole(f"board.{each.signal}") for each in numbers}


def _pulses(row: LogRow, source: str, channels: tuple[str, ...]) -> Data | None:
    pulses = {name: row.whole(f"{source}.{name}_us") for name in channels}
    return None if None in pulses.values() else dict(pulses)
