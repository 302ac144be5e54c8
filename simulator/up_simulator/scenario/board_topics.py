"""The board's messages, row by row, as Commands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from up.commands.flight_state_command import FlightStateCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand
from up.flight_log.board_status import TOPIC as STATUS_TOPIC
from up.flight_log.origin_text import KEY as ORIGIN
from up_simulator.scenario.log import Value
from up_simulator.scenario.sampler import CAUSES, MODES, SWITCH
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
        """Return a number, rounded."""
        value = self.number(name)
        return None if value is None else round(value)

    def flag(self, name: str) -> bool | None:
        value = self.number(name)
        return None if value is None else bool(value)

    def text(self, name: str) -> str | None:
        """Return a text that is not empty."""
        value = self._values.get(name)
        return value if isinstance(value, str) and value else None

    def known(self) -> Iterator[tuple[str, float | str]]:
        for name, value in self._values.items():
            if math.isfinite(value) if isinstance(value, float) else value:
                yield name, value


BOARD = "arduino (board)"
STATE_S = 1.0
_ANGLES = ("roll", "pitch", "yaw")
_LETTERS = {mode: letter for letter, mode in MODES.items()}
_POSITIONS = {position: number for number, position in SWITCH.items()}
_FLAGS = {
    "armed": 1,
    "auto": 2,
    "receiver_valid": 4,
    "imu_valid": 8,
    "failsafe": 16,
    "gains_valid": 64,
    "pi_heard": 128,
}
_RESTORED = 128
_COUNTS = {
    "loop_us": "loop_us",
    "late_us": "loop_late_us",
    "frame_errors": "dropped_frames",
    "frames_lost": "missing_frames",
    "uptime_s": "uptime_s",
    "rx_age_ms": "receiver_age_ms",
    "imu_age_ms": "imu_age_ms",
}


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
        """Yield the board's data in this row."""
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
        bits = (bit for name, bit in _FLAGS.items() if row.flag(f"board.{name}"))
        flags = sum(bits) & ~(0 if self._has_raspilot else _FLAGS["pi_heard"])
        causes = (row.text("board.reset_cause") or "").split()
        cause = sum(bit for bit, name in CAUSES.items() if name in causes)
        data: Data = {
            "mode": ord(_LETTERS.get(row.text("board.mode") or "", "\0")),
            "switch": _POSITIONS.get(row.text("board.switch") or ""),
            "flags": flags,
            "reset_cause": cause | (_RESTORED if row.flag("board.restored") else 0),
        }
        return data | {key: row.whole(f"board.{name}") for key, name in _COUNTS.items()}


def _pulses(row: LogRow, source: str, channels: tuple[str, ...]) -> Data | None:
    pulses = {name: row.whole(f"{source}.{name}_us") for name in channels}
    return None if None in pulses.values() else dict(pulses)
