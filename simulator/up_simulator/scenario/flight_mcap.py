"""A scenario's flight as a flight log, so that every program that reads those reads it."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import yaml

from up.commands.altitude_command import AltitudeCommand
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.panic_command import PanicCommand
from up.commands.rx_command import RXCommand
from up.commands.servo_command import ServoCommand
from up.commands.system_commands import LinkStateCommand
from up.flight_log.command_schema import schema_of
from up.flight_log.foxglove import LOG, LOG_LEVELS, LOG_SCHEMA, timestamp
from up.flight_log.mcap_writer import McapWriter
from up.flight_log.origin_text import KEY as ORIGIN
from up.version import VERSION
from up_simulator.aircraft.truth import NAMES, TOPIC
from up_simulator.scenario.flight_record import PendingCommand
from up_simulator.scenario.flight_topics import SIGNALS_TOPIC, FlightTopics
from up_simulator.scenario.result import Result
from up_simulator.scenario.signals import SIGNALS

BEGIN_NS = 946_684_800_000_000_000
"""2000-01-01: a simulated flight has no date, and the same flight is the same file."""
LOG_TOPIC, EVENT_TOPIC = "log", "simulator.event"
COMMANDS: tuple[type[BaseCommand], ...] = (
    AltitudeCommand,
    FlightStateCommand,
    HeadingCommand,
    LinkStateCommand,
    LocationCommand,
    OrientationCommand,
    PanicCommand,
    RXCommand,
    ServoCommand,
)
_BUFFER = 1 << 20
_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def write_flight(name: str, result: Result, path: Path) -> None:
    """Write the log of a flight with its verdicts, not of its control run; raises OSError."""
    with path.open("wb", buffering=_BUFFER) as file:
        _FlightFile(name, result, file.write).write()


class _FlightFile:
    """One flight on its way into a file."""

    def __init__(self, name: str, result: Result, write: Callable[[bytes], object]) -> None:
        self._name = name
        self._result = result
        self._record = result.record
        self._writer = McapWriter(write)
        self._channels: dict[str, int] = {}
        self._events = result.record.log.events
        scenario_events = result.record.scenario.events
        self._event_codes = {event.title: event.kinds[0] for event in scenario_events}
        self._commands = sorted(result.record.pending_commands, key=lambda each: each.sent_s)

    def write(self) -> None:
        self._writer.start()
        self._describe()
        topics = FlightTopics(self._record.scenario)
        columns, time_s = self._record.log.columns, 0.0
        for values in self._record.log.rows:
            row = dict(zip(columns, values, strict=True))
            time_s = float(row["time_s"])
            self._write_events_until(time_s)
            for topic, data in topics.messages(row):
                self._message(topic, time_s, data)
        self._close(time_s)
        self._writer.finish()

    def _describe(self) -> None:
        record, scenario = self._record, self._record.scenario
        controller = scenario.raspilot.config.get("config.yml", {}).get("flight controller")
        self._writer.add_metadata(
            "flight",
            {
                "aircraft": scenario.airframe,
                "instance": "simulator",
                "version": VERSION,
                "mode": "flight controller",
                "flight_controller": str(controller or "arduino"),
                "started": "2000-01-01T00:00:00Z",
            },
        )
        self._writer.add_metadata(
            "scenario",
            {
                "name": self._name,
                "title": scenario.title,
                "about": scenario.about,
                "seed": str(scenario.seed),
                "board": record.board_title,
                "model": record.model,
            },
        )
        for file, settings in record.settings.items():
            text = yaml.safe_dump(settings, sort_keys=False, allow_unicode=True)
            self._writer.add_attachment(f"config/{file}", "text/yaml", text.encode(), BEGIN_NS)

    def _write_events_until(self, time_s: float) -> None:
        while self._events and self._events[0][0] <= time_s:
            at_s, event = self._events.pop(0)
            code = self._event_codes.get(event, event)
            self._message(EVENT_TOPIC, at_s, {"event": event, "code": code})
            self._log(at_s, "info", f"event: {event}")
        while self._commands and self._commands[0].sent_s <= time_s:
            self._write_command(self._commands.pop(0))

    def _write_command(self, pending: PendingCommand) -> None:
        command, ground = pending.command, self._record.scenario.ground
        role = "operator" if ground is None else ground.role
        if pending.answer == "":
            data = {**command.data, ORIGIN: f"ground ({role})"}
            self._message(command.name, pending.sent_s, data)
        else:
            answer = "no answer" if pending.answer is None else f"refused, {pending.answer}"
            self._log(pending.sent_s, "warn", f"{command.name} from the ground: {answer}")

    def _close(self, time_s: float) -> None:
        record = self._record
        for trouble in (record.failure, record.crash):
            if trouble is not None:
                self._log(time_s, "error", trouble)
        verdicts: dict[str, str] = {}
        for verdict in self._result.verdicts:
            limit = f" ({verdict.limit})" if verdict.limit else ""
            state = "held" if verdict.is_held else f"NOT held, {verdict.code}"
            verdicts[verdict.name] = f"{state}: {verdict.figure}{limit}"
        self._writer.add_metadata("verdicts", verdicts)

    def _log(self, time_s: float, level: str, text: str) -> None:
        entry = {"level": LOG_LEVELS[level], "message": text, "name": "scenario"}
        stamp = timestamp(_log_ns(time_s))
        self._message(LOG_TOPIC, time_s, {"timestamp": stamp, **entry, "file": "", "line": 0})

    def _message(self, topic: str, time_s: float, data: Mapping[str, Any]) -> None:
        channel = self._channels.get(topic)
        if channel is None:
            title, schema = _schema(topic)
            number = self._writer.add_schema(title, schema)
            channel = self._channels[topic] = self._writer.add_channel(topic, number)
        text = json.dumps(data, allow_nan=False, separators=(",", ":"))
        self._writer.message(channel, _log_ns(time_s), text.encode())


def _log_ns(time_s: float) -> int:
    return BEGIN_NS + round(time_s * 1e6) * 1000


def _schema(topic: str) -> tuple[str, dict[str, Any]]:
    for command in COMMANDS:
        if topic == command.NAME:
            return topic, schema_of(command)
    if topic == LOG_TOPIC:
        return LOG, LOG_SCHEMA
    schema: dict[str, Any] = {"$schema": _DIALECT, "title": topic, "type": "object"}
    if topic == TOPIC:
        schema["description"] = "the exact state of the aircraft, unknown aboard"
        schema["properties"] = {"crashed": {"type": "boolean"}} | {
            name: _property(f"truth.{field}")
            for name, field in NAMES.items()
            if f"truth.{field}" in SIGNALS
        }
    elif topic == SIGNALS_TOPIC:
        schema["description"] = "all other signals, as 'up-sim signals' lists them"
    elif topic == EVENT_TOPIC:
        schema["description"] = "events of the scenario; code: the kind of event"
        schema["properties"] = {"event": {"type": "string"}, "code": {"type": "string"}}
    return topic, schema


def _property(signal: str) -> dict[str, str]:
    about = SIGNALS[signal]
    return {"type": "number", "description": f"{about.unit}, {about.about}", "x-unit": about.unit}
