"""Reads every signal of a flight at a moment."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

from up.commands.board_schema import DATA, FLIGHT_MODES, RESET_CAUSES, SWITCH_POSITIONS
from up.earth import distance_m
from up_flightlog.read.demand import DemandModel
from up_simulator.aircraft.dynamics import FlightDynamics
from up_simulator.aircraft.flight import FlightState
from up_simulator.firmware.line_monitor import LineMonitor
from up_simulator.harness.world import World
from up_simulator.in_process.ground import InProcessGround
from up_simulator.in_process.mavlink_ground import MavlinkGround
from up_simulator.in_process.metrics_reader import MetricsReader
from up_simulator.radio.goggles import Goggles
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.participants import Participants
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import EVENT_COLUMN, SIGNALS
from up_simulator.scenario.sticks import CHANNELS

Values = dict[str, float | bool | str | None]
_SERVOS = CHANNELS[:4]
_PLACES = {
    f"distance.{name}_m": [
        source.format(axis)
        for source in ("truth.{}_deg", f"ground.{place}.{{}}")
        for axis in ("latitude", "longitude")
    ]
    for name, place in (
        ("estimate", "navigation"),
        ("home", "home"),
        ("target", "navigation.target"),
    )
}
_TRUTH = [
    (f"truth.{field.name}", field.name)
    for field in dataclasses.fields(FlightState)
    if field.name != "time_s"
]


def columns_of(scenario: Scenario) -> list[str]:
    """Return the log's columns: those of every part that flies, and of the expectations."""
    sources = sources_of(scenario)
    columns = [name for name, signal in SIGNALS.items() if signal.source in sources]
    expected = [expectation.signal for expectation in scenario.expect]
    more = [name for name in expected if name not in SIGNALS and name.partition(".")[0] in sources]
    return [*columns, *dict.fromkeys(more), EVENT_COLUMN]


def sources_of(scenario: Scenario) -> set[str]:
    """Return the first parts of the names of signals that the parts of this flight have."""
    sources = {"time_s", "truth", "stick", "servo"}
    if scenario.has_arduino:
        sources |= {"board", "demand", "error", "estimate_error"}
    if scenario.has_raspilot:
        sources.add("raspilot")
    if scenario.phone is not None:
        sources.add("phone")
    if scenario.ground is not None:
        sources |= {"ground", "distance"}
    if scenario.goggles is not None:
        sources.add("goggles")
    if scenario.metrics:
        sources.add("metrics")
    if scenario.mavlink:
        sources.add("mavlink")
    return sources


class Sampler:
    """Gathers rows: the values of all signals at one time."""

    def __init__(
        self,
        world: World,
        board: LineBoard,
        demand: DemandModel,
        participants: Participants,
        *,
        has_flight_computer: bool,
    ) -> None:
        self._world = world
        self._board = board
        self._demand = demand
        self._participants = participants
        self._has_computer = has_flight_computer
        self._telemetry: Mapping[str, Any] = {}
        self._flat_telemetry: Values = {}

    def row(self, time_s: float, sticks_us: Mapping[str, float]) -> Values:
        values: Values = {"time_s": time_s}
        values.update(_truth(self._world.dynamics))
        values.update((f"stick.{name}_us", sticks_us[name]) for name in CHANNELS)
        pulses_us = self._board.pulses_us()
        values.update(
            (f"servo.{name}_us", pulse) for name, pulse in zip(_SERVOS, pulses_us, strict=True)
        )
        stale_us = self._board.take_max_pulse_age_us()
        values["servo.stale_ms"] = stale_us / 1e3 if stale_us < float("inf") else None
        if self._has_computer:
            values.update(_board(self._board.tap, self._board.now_s))
            self._add_demand(values, sticks_us)
        participants = self._participants
        if participants.raspilot is not None:
            values["raspilot.running"] = participants.raspilot.is_running
        if participants.phone is not None:
            values["phone.plugged"] = participants.phone.is_plugged
        if participants.ground is not None:
            values.update(_ground(participants.ground, participants.seconds()))
            values.update(self._flat_of(participants.ground.telemetry))
            values.update(_distances(values))
        if participants.goggles is not None:
            values.update(_goggles(participants.goggles, values))
        if participants.metrics is not None:
            values.update(_metrics(participants.metrics, participants.seconds()))
        if participants.mavlink is not None:
            values.update(_mavlink(participants.mavlink, participants.seconds(), values))
        return values

    def _flat_of(self, telemetry: Mapping[str, Any]) -> Values:
        """Return the values of a frame by their names; a frame serves several rows."""
        if telemetry is not self._telemetry:
            self._telemetry = telemetry
            self._flat_telemetry = dict(_flat("ground", telemetry))
        return self._flat_telemetry

    def _add_demand(self, values: Values, sticks_us: Mapping[str, float]) -> None:
        mode, is_failsafe = values.get("board.mode"), values.get("board.failsafe")
        demand = self._demand.at(str(mode), bool(is_failsafe), sticks_us)
        for name in ("roll_deg", "pitch_deg", "roll_rate_deg_s", "pitch_rate_deg_s"):
            demanded, truth = getattr(demand, name), values[f"truth.{name}"]
            values[f"demand.{name}"] = demanded
            if demanded is not None and isinstance(truth, float):
                values[f"error.{name}"] = _wrapped(truth - demanded, name)
        for name in ("roll_deg", "pitch_deg"):
            estimate, truth = values.get(f"board.{name}"), values[f"truth.{name}"]
            if isinstance(estimate, float) and isinstance(truth, float):
                values[f"estimate_error.{name}"] = _wrapped(estimate - truth, name)


def _wrapped(difference: float, name: str) -> float:
    return (difference + 180.0) % 360.0 - 180.0 if name == "roll_deg" else difference


def _truth(dynamics: FlightDynamics) -> Iterable[tuple[str, Any]]:
    state = dynamics.state
    for name, attribute in _TRUTH:
        yield name, getattr(state, attribute)
    yield "truth.crashed", dynamics.crash is not None


def _board(tap: LineMonitor, now_s: float) -> Iterable[tuple[str, Any]]:
    yield "board.bad_frames", tap.bad_frames
    if (orientation := tap.orientation) is not None:
        for angle in ("roll", "pitch", "yaw"):
            yield f"board.{angle}_deg", getattr(orientation, f"{angle}_deg")
            yield f"board.{angle}_rate_deg_s", getattr(orientation, f"{angle}_rate_deg_s")
        yield "board.orientation_age_s", now_s - tap.orientation_s
    status = tap.status
    if status is None:
        return
    yield "board.mode", FLIGHT_MODES.get(status.mode_letter, status.mode_letter)
    yield "board.switch", SWITCH_POSITIONS.get(status.switch, "not known")
    causes = (word for bit, word in RESET_CAUSES.items() if status.reset_cause >> bit & 1)
    yield "board.reset_cause", " ".join(word for word in causes if " " not in word)
    for datum in DATA:
        if datum.signal:
            number = getattr(status, datum.field)
            value = number if datum.bit is None else bool(number >> datum.bit & 1)
            yield f"board.{datum.signal}", value
    yield "board.status_age_s", now_s - tap.status_s


def _ground(ground: InProcessGround, now_s: float) -> Iterable[tuple[str, Any]]:
    yield "ground.frames", ground.frames
    yield "ground.connected", ground.is_connected
    yield "ground.in_control", ground.is_in_control
    yield "ground.age_s", None if ground.newest_s is None else now_s - ground.newest_s
    yield "ground.latency_s", ground.take_latency_s()


def _goggles(goggles: Goggles, values: Values) -> Iterable[tuple[str, float | str | None]]:
    for name in ("mode", "warning", "satellites", "altitude_m", "errors"):
        yield f"goggles.{name}", getattr(goggles, name)
    yield "goggles.bytes", goggles.received
    shown_m, home_m = goggles.altitude_m, values.get("ground.home.altitude")
    truth_m = values["truth.altitude_m"]
    if shown_m is not None and isinstance(home_m, float) and isinstance(truth_m, float):
        yield "goggles.altitude_error_m", shown_m - (truth_m - home_m)


def _metrics(reader: MetricsReader, now_s: float) -> Iterable[tuple[str, float | None]]:
    yield "metrics.age_s", None if reader.newest_s is None else now_s - reader.newest_s
    yield "metrics.figures", len(reader.values)
    yield from ((f"metrics.{name}", value) for name, value in reader.values.items())


def _mavlink(
    ground: MavlinkGround, now_s: float, values: Values
) -> Iterable[tuple[str, float | str | None]]:
    for name in ("mode", "ack", "altitude_m", "errors"):
        yield f"mavlink.{name}", getattr(ground, name)
    yield "mavlink.age_s", None if ground.newest_s is None else now_s - ground.newest_s
    truth_m = values["truth.altitude_m"]
    if ground.altitude_m is not None and isinstance(truth_m, float):
        yield "mavlink.altitude_error_m", ground.altitude_m - truth_m


def _distances(values: Values) -> Iterable[tuple[str, float]]:
    for name, sources in _PLACES.items():
        degrees = [each for key in sources if isinstance(each := values.get(key), float)]
        if len(degrees) == 4:
            yield name, distance_m(*degrees)


def _flat(prefix: str, values: Mapping[str, Any]) -> Iterable[tuple[str, Any]]:
    for key, value in values.items():
        name = f"{prefix}.{key}"
        if isinstance(value, dict):
            yield from _flat(name, value)
        elif isinstance(value, list | tuple):
            yield name, ", ".join(map(str, value))
        elif value is None or isinstance(value, bool | int | float | str):
            yield name, value
