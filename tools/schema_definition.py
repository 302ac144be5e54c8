"""Reads schema/: modes, status, telemetry, events, answers to Commands."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import yaml

FORMATS = {"u8": "B", "u16": "H"}
MAXIMUM = {"u8": 255, "u16": 65535}
# The keys of each kind of row, with their defaults; None: required.
MODE = {"letter": None, "name": None, "about": None, "holder": "", "switch": False,
        "pi": False, "flown": True, "firmware": True}  # fmt: skip
REFUSAL = {"code": None, "name": None, "text": None}
ANSWER = {"code": None, "text": None}
OUTCOME = {"code": None, "text": None, "level": "info"}
ALARM: dict[str, Any] = {
         "kind": None, "when": "", "above": "", "below": "", "back": 0, "level": "warning",
         "armed": "", "code": "", "text": "", "end_code": "", "end": "", "event": "source",
         "unless": "", "lasts": True, "hold_s": "", "awaited": {}, "cure": ""}  # fmt: skip
EVENT = {"code": None, "kind": None, "text": None, "level": "info", "first": False,
         "end_code": "", "end": "", "alarm": "", "cure": ""}  # fmt: skip
AWAITED = {"after": None, "code": None, "text": None, "level": ""}
ROW: dict[str, Any] = {
       "name": None, "type": "", "bit": "", "about": "", "unit": "", "text": "", "values": {},
       "bits": (), "telemetry": True, "signal": True, "firmware": True, "row": {}, "alarm": {},
       "second_alarm": {}, "event": {}, "finding": "", "cure": ""}  # fmt: skip
FIELD: dict[str, Any] = {
       "name": None, "of": (), "type": "number", "unit": "", "about": "", "decimals": 3,
       "reading": "", "from": "", "key": "*", "row": {}, "labels": (), "optional": False,
       "alarm": {}, "second_alarm": {}, "event": {}, "finding": "",
       "in_telemetry": True, "rules": ()}  # fmt: skip
READING = {"name": None, "title": "", "stale_s": 0, "source_s": None, "source_event": True}
TYPES = {"number": "number", "flag": "boolean", "text": "string", "texts": "array",
         "object": "object", "status": ""}  # fmt: skip

Item = SimpleNamespace


class SchemaError(Exception):
    """The definition is invalid; the text names file and row."""


class Schema:
    """The definitions: times, events, readings and fields of telemetry, the board's status."""

    def __init__(self, folder: Path) -> None:
        """Read the files; raises SchemaError."""
        self.times: dict[str, float] = {}
        for name in ("events", "telemetry", "status", "commands"):
            path = folder / f"{name}.yml"
            try:
                getattr(self, f"_read_{name}")(yaml.safe_load(path.read_text(encoding="utf-8")))
            except KeyError as error:
                raise SchemaError(f"{path}: {error} is missing") from None
            except (yaml.YAMLError, TypeError, AttributeError, OSError, SchemaError) as error:
                raise SchemaError(f"{path}: {error}") from None
        self.fields = [each for row in self.table for each in self._fields_of(row)]
        self.rules = [rule for each in self.fields for rule in each.rules]
        self.rules += [_source_rule(each.name) for each in self.readings if each.source_event]
        # The alarm of the link is the first one shown.
        hold_s = self.times["hold_s"]
        self.holds_s = {each.alarm: hold_s for each in self.events if each.alarm}
        for rule in self.rules:
            if rule["alarm"]:
                own_s = rule.get("hold_s", "")
                self.holds_s.setdefault(rule["alarm"], hold_s if own_s == "" else own_s)

    def _read_events(self, data: dict[str, Any]) -> None:
        for name in ("hold_s", "pause_s", "max_pause_s", "quiet_s"):
            self.times[name] = data[name]
        self.events = [_item(EVENT, each) for each in data["events"]]
        for each in self.events:
            _check_cure(each, each.code)

    def _read_telemetry(self, data: dict[str, Any]) -> None:
        for name in ("silent_s", "late_s", "late_for_s", "drift", "new_clock_s"):
            self.times[name] = data[name]
        self.readings = [_item(READING, each) for each in data["readings"]]
        for each in self.readings:
            each.stale_s = each.stale_s or data["silent_s"]
        ages = {"name": "age_ms", "unit": "ms", "about": "`null`: never"}
        sources = {"name": "source", "type": "text", "about": "which one the provider follows"}
        names = [each.name for each in self.readings]
        rows = [*data["fields"], *({**each, "of": names} for each in (ages, sources))]
        self.table = [_field(each, names) for each in rows]
        self.mode_reasons = data["mode_reasons"] | {
            each.name: f"{each.title or each.name} missing or too old" for each in self.readings
        }
        self.mode_texts = data["mode_texts"]

    def _read_status(self, data: dict[str, Any]) -> None:
        self.version = data["version"]
        self.oldest_size = data["oldest_size"]
        self.modes = [_item(MODE, each) for each in data["modes"]]
        self.refusals = [_item(REFUSAL, each) for each in data["refusals"]]
        self.status = [_row(each, "") for each in data["fields"]]
        self.format = ">" + "".join(FORMATS[each.type] for each in self.status)
        self.size = struct.calcsize(self.format)
        for at, each in enumerate(self.status):
            each.offset = struct.calcsize(self.format[: at + 1])
        self.bits = {each.name: each.bits for each in self.status}
        for veto in (each for each in self.bits.get("vetoes", ()) if each.firmware):
            _check_cure(veto, veto.name)
        self.rows = [row for each in self.status for row in (each, *each.bits)]

    def _read_commands(self, data: dict[str, Any]) -> None:
        self.answers = [_item(ANSWER, each) for each in data["answers"]]
        self.outcomes = [_item(OUTCOME, each) for each in data["outcomes"]]

    def _fields_of(self, row: Item) -> Iterator[Item]:
        """Yield the fields that a row of the table of telemetry stands for."""
        if row.type != "status":
            names = row.of or ("",)
            for name, label in zip(names, row.labels or ("",) * len(names), strict=True):
                path = f"{row.name}.{name}".rstrip(".")
                key = row.key.replace("*", path.rpartition(".")[2])
                own = {"name": path, "key": key, "label": label, "rules": _rules(row, path)}
                yield Item(**vars(row) | own)
            return
        for each in self.rows:
            if each.in_telemetry or each.alarm:
                known = {key: getattr(each, key) for key in FIELD if hasattr(each, key)}
                path = f"{row.name}.{each.name}"
                own = {"name": path, "type": each.kind, "reading": row.reading}
                yield Item(**FIELD | known | own | {"label": "", "rules": _rules(each, path)})


def _item(keys: dict[str, Any], data: dict[str, Any]) -> Item:
    place = data.get("name", data)
    for key in data.keys() - keys.keys():
        raise SchemaError(f"{place}: unknown key '{key}'")
    for key, default in keys.items():
        if default is None and key not in data:
            raise SchemaError(f"{place}: '{key}' is missing")
    return Item(**{**keys, **data})


def _field(data: dict[str, Any], readings: list[str]) -> Item:
    row = _item(FIELD, data)
    if row.reading and row.reading not in readings:
        raise SchemaError(f"{row.name}: unknown reading '{row.reading}'")
    if row.labels and len(row.labels) != len(row.of or (row.name,)):
        raise SchemaError(f"{row.name}: labels must be as many as the fields")
    if row.type not in TYPES:
        raise SchemaError(f"{row.name}: type must be one of {', '.join(TYPES)}")
    row.kind = row.type
    _rules(row, row.name)
    return row


def _row(data: dict[str, Any], field: str) -> Item:
    """Return a field of the status, or a bit of one, with the attributes derived from its keys."""
    row = _item(ROW, data)
    row.field = field or row.name
    row.bits = [_row(each, row.name) for each in row.bits]
    if (row.type not in FORMATS) == (row.bit == ""):
        raise SchemaError(f"{row.name}: type must be one of {', '.join(FORMATS)}")
    row.kind = "flag" if row.bit != "" else "text" if row.bits or row.values else "number"
    # Other bits with a text are items of a list.
    is_datum = not row.bits and bool(row.row or not row.text)
    row.in_telemetry = row.telemetry == "text" or bool(row.telemetry and is_datum)
    row.signal = "" if not is_datum else row.name if row.signal is True else row.signal or ""
    row.has_property = is_datum and row.bit != ""
    _rules(row, row.name)
    return row


def _rules(row: Item, path: str) -> list[dict[str, Any]]:
    """Return the rules that follow from a row's alarms and events; raises SchemaError."""
    rules = []
    for given in filter(None, (row.alarm, row.second_alarm)):
        alarm = _item(ALARM, {"kind": path.rpartition(".")[2], **given})
        if [alarm.when, alarm.above, alarm.below].count("") != 2:
            raise SchemaError(f"{row.name}: alarm: give one of 'when', 'above' and 'below'")
        code = alarm.code or row.name
        finding = alarm.text if row.finding == "" else row.finding or ""
        rule = {
            "path": path, "type": row.kind, "event": alarm.event, "code": code,
            "level": alarm.level, "text": alarm.text, "end": alarm.end,
            "end_code": alarm.end_code or f"{code}_over" if alarm.end else "",
            "alarm": alarm.kind if alarm.lasts else "", "level_armed": alarm.armed or alarm.level,
            "unless": alarm.unless and f"{path.rpartition('.')[0]}.{alarm.unless}",
            "when": alarm.when, "above": alarm.above, "below": alarm.below, "back": alarm.back,
            "finding": finding, "hold_s": alarm.hold_s, "cure": alarm.cure,
        }  # fmt: skip
        if alarm.event or alarm.lasts:
            _check_cure(alarm, row.name)
        if alarm.awaited:
            awaited = _item(AWAITED, alarm.awaited)
            rule |= {"awaits": tuple(awaited.after), "awaited_code": awaited.code,
                     "awaited_text": awaited.text, "awaited_level": awaited.level}  # fmt: skip
        rules.append(rule)
    if row.event:
        event = _item(EVENT, row.event)
        _check_cure(event, row.name)
        rules.append(event_rule(event) | {"path": path, "type": row.kind})
    return rules


def _check_cure(item: Item, place: str) -> None:
    """Raise SchemaError where docs/troubleshooting.md has nothing to say to a warning or a veto."""
    if not item.cure and getattr(item, "level", "veto") != "info":
        raise SchemaError(f"{place}: 'cure' is missing")


def event_rule(event: Item) -> dict[str, Any]:
    return {"event": event.kind, "code": event.code, "level": event.level, "text": event.text,
            "end_code": event.end_code, "end": event.end, "first": event.first,
            "alarm": event.alarm, "cure": event.cure}  # fmt: skip


def _source_rule(reading: str) -> dict[str, Any]:
    text = f"{reading} comes from {{value}} (was {{before}})"
    cure = "the first one fell silent, or is back; their order is in `providers.yml`"
    return {"path": f"source.{reading}", "type": "text", "event": "source", "level": "warning",
            "code": "source_changed", "text": text, "alarm": "", "cure": cure}  # fmt: skip
