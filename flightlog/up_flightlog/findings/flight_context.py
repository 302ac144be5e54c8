"""Data that several checks of one flight need, computed once."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from typing import Any

from up.commands import board_status
from up.commands.board_schema import DATA, PI_MODES
from up.commands.schema_rows import Rule
from up.commands.telemetry_schema import RULES
from up.flight_log.json_message import number_at, value_at
from up_flightlog.findings.estimate_error import (
    ORIENTATION,
    TRUTH,
    EstimateError,
    estimate_errors,
)
from up_flightlog.read.flight_log import FlightLog, LoggedMessage
from up_flightlog.read.series import Series
from up_flightlog.read.source_filter import from_selected_source
from up_flightlog.read.spans import Span, spans_of

TELEMETRY = "up.telemetry.update"
FLIGHT_STATE = "up.flight.state"
LINK_STATE = "up.link.state"
SIGNALS = "simulator.signals"
RX, ALTITUDE = "up.rx.update", "up.altitude.change"
CHANNELS = ("ailerons", "elevator", "throttle", "rudder")
INPUTS = (*CHANNELS, "aux1", "aux2")
LOG = "log"
ANGLES = ("roll", "pitch", "yaw")
TRUTHS = (
    *("roll_deg", "pitch_deg", "yaw_deg", "altitude_m", "latitude_deg", "longitude_deg"),
    *("airspeed_m_s", "ground_speed_m_s", "wind_north_m_s", "wind_east_m_s"),
)
WARNING, ERROR = 3, 4
"""Levels of foxglove.Log."""
_CODES = frozenset({"command_refused", "recording_resumed"})
"""Lines of level info that are read."""
_DATA = {f"arduino.{each.name}": each for each in DATA}
_PATHS = {
    *(rule.path for rule in RULES if rule.finding and rule.path not in _DATA),
    *("flight_mode", "flight_control.mode", "armed", "arduino.failsafe"),
    *("android.competitor", "vetoes"),
}
"""Fields of telemetry that `FlightContext.telemetry` yields."""
_NEAR_S = 1.0
_ENDING_S = 2.0
"""A program that stops closes its links up to this long before the log ends."""


@dataclass(frozen=True, slots=True)
class State:
    """The authority from that moment on; None: unknown."""

    time_s: float
    flight_mode: str | None
    is_armed: bool | None
    is_auto: bool | None
    is_failsafe: bool | None


@dataclass(frozen=True, slots=True)
class LogLine:
    """A line of the program's log; ``level`` is foxglove.Log's; ``code`` is "" without one."""

    time_s: float
    level: int
    name: str
    text: str
    code: str = ""
    fields: Mapping[str, Any] = field(default_factory=dict)


class FlightContext:
    """A flight with its states and spans, each read from the log on first use."""

    def __init__(self, log: FlightLog) -> None:
        self.log = log

    @cached_property
    def states(self) -> list[State]:
        """Return the changes of authority: from the board's status, otherwise from telemetry."""
        if FLIGHT_STATE in self.log.topics:
            return list(_changes(map(_state_of, self.log.messages(FLIGHT_STATE))))
        failsafes = (_flag(failsafe) for _, failsafe in self.telemetry("arduino.failsafe"))
        modes, armed = self.telemetry("flight_mode"), self.telemetry("armed")
        return list(
            _changes(
                State(time_s, _text(mode), _flag(is_armed), None, is_failsafe)
                for (time_s, mode), (_, is_armed), is_failsafe in zip(
                    modes, armed, failsafes, strict=True
                )
            )
        )

    @cached_property
    def modes(self) -> list[tuple[float, str | None]]:
        """Return the changes of the mode that flies: the Raspberry Pi's while the board follows it.

        That of a board's change is in a frame soon after it.
        """
        frames = [(time_s, _text(mode)) for time_s, mode in self._pi_modes()]
        times_s = [time_s for time_s, _ in frames]
        found: list[tuple[float, str | None]] = []
        ends_s = [*(state.time_s for state in self.states[1:]), math.inf]
        for state, end_s in zip(self.states, ends_s, strict=False):
            followed: list[tuple[float, str | None]] = []
            if state.flight_mode in PI_MODES:
                first = bisect_left(times_s, state.time_s)
                followed = frames[first : bisect_left(times_s, end_s)] or frames[first : first + 1]
            near_s = state.time_s + _NEAR_S
            named = (mode for time_s, mode in followed if mode is not None and time_s < near_s)
            found.append((state.time_s, next(named, state.flight_mode)))
            found += [each for each in followed[1:] if each[1] is not None]
        return [next(same) for _, same in groupby(found, key=lambda each: each[1])]

    def _pi_modes(self) -> Iterator[tuple[float, Any]]:
        if TELEMETRY in self.log.topics:
            yield from self.telemetry("flight_control.mode")
            return
        # The log of a scenario has what the ground saw.
        keys = ("ground", "flight_control", "mode")
        for times_s, signals in self.log.batches(SIGNALS):
            yield from zip(times_s, (value_at(each, keys) for each in signals), strict=True)

    @cached_property
    def armed(self) -> list[Span]:
        return self.spans((state.time_s, state.is_armed is True) for state in self.states)

    @cached_property
    def log_lines(self) -> list[LogLine]:
        """Return the warnings and errors of the program's log, and infos that are findings."""
        lines = self._all_lines()
        return [line for line in lines if line.level >= WARNING or line.code in _CODES]

    @cached_property
    def attitude(self) -> dict[str, Series]:
        return from_selected_source(self.log, "orientation", ORIENTATION, ANGLES)

    @cached_property
    def altitude(self) -> Series:
        found = from_selected_source(self.log, "altitude", ALTITUDE, ("altitude",))
        return found["altitude"]

    @cached_property
    def sticks(self) -> dict[str, Series]:
        """Return the pilot's pulses, us, and ``valid``, a bit for each of them."""
        return self.log.columns(RX, (*INPUTS, "valid"))

    @cached_property
    def truth(self) -> dict[str, Series]:
        """Return ground truth by its names; a real flight has none."""
        return self.log.columns(TRUTH, TRUTHS)

    @cached_property
    def estimate_errors(self) -> list[EstimateError]:
        truth = {axis.removesuffix("_deg"): series for axis, series in self.truth.items()}
        return list(estimate_errors(self.attitude, truth))

    @cached_property
    def last_telemetry(self) -> dict[str, Any]:
        """Return the last logged frame of telemetry; empty without one."""
        times_s = self.log.times(TELEMETRY)
        if not times_s:
            return {}
        newest: dict[str, Any] = {}
        for message in self.log.messages(TELEMETRY, since_s=times_s[-1]):
            newest = message.data
        return newest

    def first_telemetry(self, since_s: float) -> dict[str, Any]:
        """Return the first frame of telemetry from a time on; empty without one."""
        for message in self.log.messages(TELEMETRY, since_s=since_s):
            return message.data
        return {}

    def spans(self, states: Iterable[tuple[float, bool]]) -> list[Span]:
        return spans_of(states, self.log.length_s)

    def was_armed(self, span: Span) -> bool:
        """Return whether it was armed in a span or just before: a lost board reports nothing."""
        before = bisect_right(self.armed, span.end_s, key=lambda each: each.begin_s)
        return before > 0 and self.armed[before - 1].end_s >= span.begin_s - _NEAR_S

    def state_at(self, time_s: float) -> State | None:
        """Return the authority at a time; None if it was not logged yet."""
        before = bisect_right(self.states, time_s, key=lambda each: each.time_s)
        return self.states[before - 1] if before else None

    def lost(self, states: Iterable[tuple[float, bool | None]]) -> list[Span]:
        """Return the spans in which a condition was false after it had been true."""
        return self.spans(_after_first(states))

    def alarm_spans(self, rule: Rule) -> list[Span]:
        """Return the spans in which a condition held after it had not."""
        return self.lost(_negated(rule, self._values(rule)))

    def _values(self, rule: Rule) -> Iterator[tuple[float, Any]]:
        """Yield the values of a rule's field; the Arduino's are read from its status."""
        if rule.path in _DATA:
            for each in self.statuses:
                yield each.time_s, board_status.value_of(each.data, _DATA[rule.path])
            return
        for time_s, value in self.telemetry(rule.path):
            yield time_s, _flag(value) if rule.type == "flag" else number_at(value, ())

    @cached_property
    def statuses(self) -> list[LoggedMessage]:
        """Return the board's status, which most checks read: a few messages a second."""
        return list(self.log.messages(board_status.TOPIC))

    def telemetry(self, path: str) -> Iterator[tuple[float, Any]]:
        """Yield the times and values of a field of ``_PATHS`` in logged frames; None: unknown."""
        times_s, columns = self._telemetry
        return zip(times_s, columns[path], strict=True)

    @cached_property
    def _telemetry(self) -> tuple[list[float], dict[str, list[Any]]]:
        # Frames are large: they are decoded once, and only these values are kept.
        times_s: list[float] = []
        columns: dict[str, list[Any]] = {path: [] for path in _PATHS}
        for some_s, frames in self.log.batches(TELEMETRY):
            times_s += some_s
            for path, values in columns.items():
                keys = path.split(".")
                values += [value_at(each, keys) for each in frames]
        return times_s, columns

    def link_lost(self, is_it: Callable[[str], bool]) -> list[Span]:
        """Return the spans in which a link was down; the program's own end is excluded."""
        lost = self.lost(
            (each.time_s, each.data.get("connected") is True)
            for each in self.log.messages(LINK_STATE)
            if is_it(str(each.data.get("link")))
        )
        return [span for span in lost if not span.is_open or span.length_s > _ENDING_S]

    def _all_lines(self) -> Iterator[LogLine]:
        for each in self.log.messages(LOG):
            level = each.data.get("level")
            yield LogLine(
                each.time_s,
                level if type(level) is int else 0,
                str(each.data.get("name", "")),
                str(each.data.get("message", "")),
                str(each.data.get("code", "")),
                fields if isinstance(fields := each.data.get("fields"), dict) else {},
            )


def _negated(
    rule: Rule, values: Iterable[tuple[float, Any]]
) -> Iterator[tuple[float, bool | None]]:
    holds: bool | None = None
    for time_s, value in values:
        holds = rule.holds(value, holds is True)
        yield time_s, None if holds is None else not holds


def _after_first(states: Iterable[tuple[float, bool | None]]) -> Iterator[tuple[float, bool]]:
    was_good = False
    for time_s, is_good in states:
        was_good = was_good or is_good is True
        if was_good and is_good is not None:
            yield time_s, not is_good


def _changes(states: Iterable[State]) -> Iterator[State]:
    before: tuple[object, ...] = ()
    for state in states:
        now = (state.flight_mode, state.is_armed, state.is_auto, state.is_failsafe)
        if now != before:
            before = now
            yield state


def _state_of(message: LoggedMessage) -> State:
    data = message.data
    return State(
        message.time_s,
        _text(data.get("flight_mode")),
        _flag(data.get("armed")),
        _flag(data.get("auto")),
        _flag(data.get("failsafe")),
    )


def _text(value: Any) -> str | None:
    return value if isinstance(value, str) else None


def _flag(value: Any) -> bool | None:
    return value if isinstance(value, bool) else None
