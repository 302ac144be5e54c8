"""What a row of a scenario's log is in a flight log: the Commands that meant the same aboard."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from up.commands.altitude_command import AltitudeCommand
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand
from up.flight_log.origin_text import KEY as ORIGIN
from up_simulator.scenario.log import ROW_S, Value
from up_simulator.scenario.signals import Kind, signal_of
from up_simulator.scenario.sticks import CHANNELS
from up_simulator.truth import NAMES, TOPIC

COMMANDS: tuple[type[BaseCommand], ...] = (
    OrientationCommand,
    RXCommand,
    ServoCommand,
    FlightStateCommand,
    LocationCommand,
    AltitudeCommand,
    HeadingCommand,
)
SIGNALS_TOPIC, BATTERY_TOPIC = "simulator.signals", "android.battery"
SIGNALS_S, PLACE_S, STATE_S = 0.1, 0.2, 1.0
BOARD, PHONE, TRUTH = "arduino (board)", "android (sensor)", "simulator (sensor)"
Data = dict[str, Any]
Message = tuple[str, Data]
_ANGLES = ("roll", "pitch", "yaw")


class FlightTopics:
    """Turns rows into messages, in the order of their times.

    What the Arduino says is a message when it says it: one that is silent leaves a gap. Where no
    phone flies the place is the true one, and its origin says so.
    """

    def __init__(self, has_phone: bool) -> None:
        self._has_phone = has_phone
        self._row: Mapping[str, Value] = {}
        self._orientation_age_s = math.inf
        self._state: Data = {}
        self._state_due_s = self._signals_due_s = self._place_due_s = -math.inf
        self._frames: float | None = None
        self._battery: float | None = None

    def messages(self, row: Mapping[str, Value]) -> Iterator[Message]:
        """Yield topic and data of everything that this row tells."""
        self._row = row
        time_s = self._number("time_s") or 0.0
        yield TOPIC, self._truth()
        yield from self._attitude()
        if (inputs := self._pulses("stick", CHANNELS)) is not None:
            is_valid = self._flag("board.receiver_valid")
            valid = 0 if is_valid is False else ALL_VALID
            yield RXCommand.NAME, {**inputs, "valid": valid, ORIGIN: BOARD}
        if (outputs := self._pulses("servo", CHANNELS[:4])) is not None:
            yield ServoCommand.NAME, {**outputs, ORIGIN: BOARD}
        yield from self._flight_state(time_s)
        yield from self._seen_by_phone() if self._has_phone else self._true_place(time_s)
        if time_s >= self._signals_due_s - ROW_S / 2:
            self._signals_due_s = time_s + SIGNALS_S
            yield SIGNALS_TOPIC, self._signals()

    def _truth(self) -> Data:
        values = {name: self._number(f"truth.{field}") for name, field in NAMES.items()}
        values["time_s"] = self._number("time_s")
        known: Data = {name: value for name, value in values.items() if value is not None}
        return {**known, "crashed": bool(self._flag("truth.crashed"))}

    def _attitude(self) -> Iterator[Message]:
        age_s, before_s = self._number("board.orientation_age_s"), self._orientation_age_s
        if age_s is None:
            return
        self._orientation_age_s = age_s
        # It grows by a row's time unless there was news.
        if age_s >= before_s + 0.9 * ROW_S:
            return
        data: Data = {angle: self._number(f"board.{angle}_deg") for angle in _ANGLES}
        data |= {f"{angle}_rate": self._number(f"board.{angle}_rate_deg_s") for angle in _ANGLES}
        yield OrientationCommand.NAME, {**data, ORIGIN: BOARD}

    def _pulses(self, source: str, channels: tuple[str, ...]) -> Data | None:
        pulses = {name: self._number(f"{source}.{name}_us") for name in channels}
        if None in pulses.values():
            return None
        return {name: round(pulse) for name, pulse in pulses.items() if pulse is not None}

    def _flight_state(self, time_s: float) -> Iterator[Message]:
        mode = self._row.get("board.mode")
        if not mode:
            return
        state: Data = {"flight_mode": mode}
        state |= {name: self._flag(f"board.{name}") for name in ("armed", "auto", "failsafe")}
        if state != self._state or time_s >= self._state_due_s:
            self._state, self._state_due_s = state, time_s + STATE_S
            yield FlightStateCommand.NAME, {**state, ORIGIN: BOARD}

    def _seen_by_phone(self) -> Iterator[Message]:
        """What the phone measured, as far as a ground station was told of it."""
        frames = self._number("ground.frames")
        if frames is None or frames == self._frames:
            return
        self._frames = frames
        latitude = self._number("ground.location.latitude")
        longitude = self._number("ground.location.longitude")
        if latitude is not None and longitude is not None:
            place: Data = {"latitude": latitude, "longitude": longitude}
            altitude = self._number("ground.location.altitude")
            yield LocationCommand.NAME, {**place, "altitude": altitude, ORIGIN: PHONE}
        if (altitude := self._number("ground.altitude")) is not None:
            yield AltitudeCommand.NAME, {"altitude": altitude, "mode": "actual", ORIGIN: PHONE}
        if (heading := self._number("ground.heading.actual")) is not None:
            yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: PHONE}
        level = self._number("ground.android.batteryLevel")
        if level is not None and level != self._battery:
            self._battery = level
            yield BATTERY_TOPIC, {"level": level, ORIGIN: PHONE}

    def _true_place(self, time_s: float) -> Iterator[Message]:
        if time_s < self._place_due_s - ROW_S / 2:
            return
        self._place_due_s = time_s + PLACE_S
        keys = {"latitude": "latitude_deg", "longitude": "longitude_deg", "altitude": "altitude_m",
                "speed": "speed_m_s", "bearing": "track_deg"}  # fmt: skip
        place: Data = {key: self._number(f"truth.{field}") for key, field in keys.items()}
        if None in place.values():
            return
        yield LocationCommand.NAME, {**place, ORIGIN: TRUTH}
        altitude, heading = place["altitude"], self._number("truth.yaw_deg")
        yield AltitudeCommand.NAME, {"altitude": altitude, "mode": "actual", ORIGIN: TRUTH}
        yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: TRUTH}

    def _signals(self) -> Data:
        """Return all that is neither the truth nor an event, by its dotted names."""
        tree: Data = {}
        for name, value in self._row.items():
            source, _, rest = name.partition(".")
            is_known = math.isfinite(value) if isinstance(value, float) else bool(value)
            if source == "truth" or not rest or not is_known:
                continue
            if signal_of(name).kind is Kind.FLAG:
                value = bool(value)
            _hang(tree, name.split("."), value)
        return tree

    def _number(self, name: str) -> float | None:
        value = self._row.get(name)
        return value if isinstance(value, float) and math.isfinite(value) else None

    def _flag(self, name: str) -> bool | None:
        value = self._number(name)
        return None if value is None else bool(value)


def _hang(tree: Data, path: list[str], value: Value | bool) -> None:
    """Put a value into nested maps; where a value is in the way the rest stays one key."""
    *above, last = path
    for at, part in enumerate(above):
        below = tree.setdefault(part, {})
        if not isinstance(below, dict):
            tree[".".join([*above[at:], last])] = value
            return
        tree = below
    tree[last] = value
