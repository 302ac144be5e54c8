"""Converts a row of a scenario's log to the Commands of a flight log."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from up.commands.altitude_command import AltitudeCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.panic_command import PanicCommand
from up.commands.system_commands import LinkStateCommand
from up.flight_log.origin_text import KEY as ORIGIN
from up_simulator.aircraft.truth import NAMES, TOPIC
from up_simulator.scenario.board_topics import (
    BOARD,
    BoardTopics,
    Data,
    FreshnessDetector,
    LogRow,
    Message,
)
from up_simulator.scenario.log import ROW_S, Value
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import Kind, signal_of

SIGNALS_TOPIC = "simulator.signals"
SIGNALS_S = 0.1


class FlightTopics:
    """Turns the rows of a scenario's log into messages, in the order of their times."""

    def __init__(self, scenario: Scenario) -> None:
        self._board = BoardTopics(scenario.has_raspilot)
        self._true_position = TruePositionTopics() if scenario.phone is None else None
        self._seen = GroundTopics()
        self._signals_due_s = -math.inf

    def messages(self, values: Mapping[str, Value]) -> Iterator[Message]:
        row = LogRow(values)
        yield TOPIC, _truth(row)
        yield from self._board.messages(row)
        yield from self._seen.messages(row)
        if self._true_position is not None:
            yield from self._true_position.messages(row)
        if row.time_s >= self._signals_due_s - ROW_S / 2:
            self._signals_due_s = row.time_s + SIGNALS_S
            yield SIGNALS_TOPIC, _signals(row)


def _truth(row: LogRow) -> Data:
    values: Data = {name: row.number(f"truth.{field}") for name, field in NAMES.items()}
    values |= {"time_s": row.time_s, "crashed": bool(row.flag("truth.crashed"))}
    return {name: value for name, value in values.items() if value is not None}


def _signals(row: LogRow) -> Data:
    """Return all that is neither the truth nor an event, by its dotted names."""
    tree: Data = {}
    for name, value in row.known():
        source, _, rest = name.partition(".")
        if source != "truth" and rest:
            is_flag = signal_of(name).kind is Kind.FLAG
            _insert(tree, name.split("."), bool(value) if is_flag else value)
    return tree


def _insert(tree: Data, path: list[str], value: Value | bool) -> None:
    """Put a value into nested maps; if a value is in the way the rest stays one key."""
    *above, last = path
    for at, part in enumerate(above):
        below = tree.setdefault(part, {})
        if not isinstance(below, dict):
            tree[".".join([*above[at:], last])] = value
            return
        tree = below
    tree[last] = value


BATTERY_TOPIC = "android.battery"
POSITION_S = 0.2
SHARE = 0.5
PHONE, TRUTH, INTERNAL = "android (sensor)", "simulator (sensor)", "internal"
_TRUE_POSITION = {
    "latitude": "latitude_deg",
    "longitude": "longitude_deg",
    "altitude": "altitude_m",
    "speed": "speed_m_s",
    "bearing": "track_deg",
}


class TruePositionTopics:
    """The true position, five times a second, without a phone; its origin field marks it."""

    def __init__(self) -> None:
        self._due_s = -math.inf

    def messages(self, row: LogRow) -> Iterator[Message]:
        if row.time_s < self._due_s - ROW_S / 2:
            return
        self._due_s = row.time_s + POSITION_S
        position: Data = {key: row.number(f"truth.{name}") for key, name in _TRUE_POSITION.items()}
        heading = row.number("truth.yaw_deg")
        if None in position.values() or heading is None:
            return
        yield LocationCommand.NAME, {**position, ORIGIN: TRUTH}
        altitude: Data = {"altitude": position["altitude"], "mode": "actual"}
        yield AltitudeCommand.NAME, {**altitude, ORIGIN: TRUTH}
        yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: TRUTH}


class GroundTopics:
    """The phone's measurements and the daemon's notes, as received by a ground station."""

    def __init__(self) -> None:
        self._frames: float | None = None
        self._detectors = {
            name: FreshnessDetector(SHARE)
            for name in ("location", "altitude", "heading", "battery")
        }
        self._links: dict[str, bool] = {}
        self._panic: Data = {}

    def messages(self, row: LogRow) -> Iterator[Message]:
        frames = row.number("ground.frames")
        if frames is None or frames == self._frames:
            return
        self._frames = frames
        fresh = {name for name, detector in self._detectors.items() if _is_new(detector, name, row)}
        if "location" in fresh:
            yield from _location(row)
        if "altitude" in fresh and (altitude := row.number("ground.altitude")) is not None:
            yield AltitudeCommand.NAME, {"altitude": altitude, "mode": "actual", ORIGIN: PHONE}
        if "heading" in fresh and (heading := row.number("ground.heading.actual")) is not None:
            yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: PHONE}
        if "battery" in fresh and (level := row.whole("ground.android.batteryLevel")) is not None:
            yield BATTERY_TOPIC, {"level": level, ORIGIN: PHONE}
        yield from self._states(row)

    def _states(self, row: LogRow) -> Iterator[Message]:
        for link in ("arduino", "android"):
            is_connected = row.flag(f"ground.{link}.connected")
            if is_connected is not None and is_connected != self._links.get(link):
                self._links[link] = is_connected
                data: Data = {"link": link, "connected": is_connected}
                yield (
                    LinkStateCommand.NAME,
                    {**data, ORIGIN: BOARD if link == "arduino" else INTERNAL},
                )
        is_panic, delay_ms = row.flag("ground.load.panic"), row.whole("ground.load.delay_ms")
        panic: Data = {"panic": is_panic, "delay_ms": delay_ms}
        if None not in panic.values() and panic != self._panic:
            self._panic = panic
            yield PanicCommand.NAME, {**panic, ORIGIN: INTERNAL}


def _is_new(detector: FreshnessDetector, name: str, row: LogRow) -> bool:
    age_ms = row.number(f"ground.age_ms.{name}")
    return detector.is_new(None if age_ms is None else age_ms / 1000, row.time_s)


def _location(row: LogRow) -> Iterator[Message]:
    keys = ("latitude", "longitude", "altitude")
    position: Data = {key: row.number(f"ground.location.{key}") for key in keys}
    if position["latitude"] is not None and position["longitude"] is not None:
        yield LocationCommand.NAME, {**position, ORIGIN: PHONE}
