#!/usr/bin/env python3
"""Writes the tables that schema/status.yml defines, in every language: ``tools/schema.py``.

``--check`` writes nothing and fails if a table differs; ``--root FOLDER`` works on another tree.
"""

from __future__ import annotations

import argparse
import json
import re
import struct
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import yaml

SOURCE = "schema/status.yml"
NOTE = f"Generated from {SOURCE} by tools/schema.py; do not edit."
FORMATS = {"u8": "B", "u16": "H"}
MAXIMUM = {"u8": 255, "u16": 65535}
# The keys of each kind of row, with their defaults; None: required.
MODE = {"letter": None, "name": None, "about": None, "holder": "", "switch": False,
        "flown": True, "firmware": True}  # fmt: skip
REFUSAL = {"code": None, "name": None, "text": None}
ALARM = {"kind": None, "when": "", "above": "", "level": "warning", "armed": "", "code": "",
         "text": "", "end_code": "", "end": "", "event": "source", "unless": "",
         "lasts": True, "hold_s": ""}  # fmt: skip
ROW: dict[str, Any] = {
       "name": None, "type": "", "bit": "", "about": "", "unit": "", "text": "", "values": {},
       "bits": (), "telemetry": True, "signal": True, "firmware": True, "row": {}, "alarm": {},
       "finding": ""}  # fmt: skip

Item = SimpleNamespace


class SchemaError(Exception):
    """The definition is invalid; the text names file and row."""


class Status:
    """The definition: modes, refusals, and the fields of the status with their offsets."""

    def __init__(self, path: Path) -> None:
        """Read the file; raises SchemaError."""
        try:
            data = yaml.safe_load(path.read_text(encoding="utf-8"))
            self.version, self.alarm_hold_s = data["version"], data["alarm_hold_s"]
            self.modes = [_item(MODE, each) for each in data["modes"]]
            self.refusals = [_item(REFUSAL, each) for each in data["refusals"]]
            self.fields = [_row(each, "") for each in data["fields"]]
        except KeyError as error:
            raise SchemaError(f"{path}: {error} is missing") from None
        except (yaml.YAMLError, TypeError, AttributeError, OSError, SchemaError) as error:
            raise SchemaError(f"{path}: {error}") from None
        self.format = ">" + "".join(FORMATS[each.type] for each in self.fields)
        self.size = struct.calcsize(self.format)
        for at, each in enumerate(self.fields):
            each.offset = struct.calcsize(self.format[: at + 1])
        self.bits = {each.name: each.bits for each in self.fields}
        self.rows = [row for each in self.fields for row in (each, *each.bits)]
        self.alarms = [(each, each.alarm) for each in self.rows if each.alarm]


def _item(keys: dict[str, Any], data: dict[str, Any]) -> Item:
    place = data.get("name", data)
    for key in data.keys() - keys.keys():
        raise SchemaError(f"{place}: unknown key '{key}'")
    for key, default in keys.items():
        if default is None and key not in data:
            raise SchemaError(f"{place}: '{key}' is missing")
    return Item(**{**keys, **data})


def _row(data: dict[str, Any], field: str) -> Item:
    """Return a field, or a bit of one, with what follows from its keys."""
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
    if row.alarm:
        row.alarm = alarm = _item(ALARM, {"kind": row.name, **row.alarm})
        if (alarm.when == "") == (alarm.above == ""):
            raise SchemaError(f"{row.name}: alarm: give either 'when' or 'above'")
        alarm.armed = alarm.armed or alarm.level
        alarm.code = alarm.code or row.name
        alarm.end_code = alarm.end_code or f"{alarm.code}_over"
        row.finding = alarm.text if row.finding == "" else row.finding or ""
    return row


def cpp(status: Status) -> str:
    """Return the firmware's header: offsets, bits and codes."""

    def enum(head: str, about: str, rows: list[tuple[str, Any]]) -> str:
        items = ",\n".join(f"  {name} = {number}" for name, number in rows)
        return f"/** {about} */\nenum {head} {{\n{items}\n}};\n\n"

    def bits(prefix: str, field: str) -> list[tuple[str, Any]]:
        rows = (each for each in status.bits[field] if each.firmware)
        return [(f"{prefix}_{each.name.upper()}", 1 << each.bit) for each in rows]

    modes = [(m.name, f"'{m.letter}'") for m in status.modes if m.flown and m.firmware]
    refusals = [(each.name.upper(), each.code) for each in status.refusals]
    offsets = [(f"AT_{each.name.upper()}", each.offset) for each in status.fields]
    return (
        f"/** Codes of the serial line and layout of the status message.\n *  {NOTE} */\n"
        "#pragma once\n\n#include <stdint.h>\n\nnamespace raspilot {\n\n"
        f"constexpr uint8_t PROTOCOL_VERSION = {status.version};\n"
        f"constexpr uint8_t STATUS_SIZE = {status.size};\n\n"
        + enum("class Mode : char", "Flight modes by their letter on the wire.", modes)
        + enum("class Reason : uint8_t", "Refusals of a Command.", [("NONE", 0), *refusals])
        + enum("Veto : uint8_t", "Veto bits of the status.", bits("VETO", "vetoes"))
        + enum("ResetCause : uint8_t", "Reset cause bits.", bits("RESET", "reset_cause"))
        + enum("StatusFlag : uint8_t", "Flags of the status.", bits("FLAG", "flags"))
        + enum("StatusOffset : uint8_t", "Offsets of the fields, big-endian.", offsets)
        + "}  // namespace raspilot\n"
    )


def python(status: Status) -> str:
    """Return the module of tables for cog, flight log, ground station and simulator."""

    def enum(head: str, rows: list[tuple[str, int]]) -> list[str]:
        return ["", "", f"class {head}:", *(f"    {name.upper()} = {code}" for name, code in rows)]

    def bits(field: str) -> list[tuple[str, int]]:
        return [(each.name, 1 << each.bit) for each in status.bits[field]]

    def call(kind: str, row: Item, *more: Any) -> str:
        bit = None if row.bit == "" else row.bit
        return f"    {kind}{(row.name, row.field, bit, *more)!r},"

    def none(value: Any) -> Any:
        return None if value == "" else value

    positions = {k: v for r in status.fields if r.name == "switch" for k, v in r.values.items()}
    positions.pop(255)
    return "\n".join([
        f'"""Codes, fields and alarms of the board\'s status. {NOTE}"""',
        "# ruff: noqa: D101, E501, RUF100", "# fmt: off", "",
        "from __future__ import annotations", "", "from dataclasses import dataclass",
        "from enum import IntEnum, IntFlag", "from struct import Struct", "",
        "from up.commands.board_datum import Alarm, Datum",
        "from up.commands.command import value", "",
        f"VERSION = {status.version}", f"STATUS = Struct({status.format!r})",
        f"ALARM_HOLD_S = {status.alarm_hold_s}",
        f"FLIGHT_MODES = { {m.letter: m.name for m in status.modes if m.flown} }",
        f"MODE_TEXTS = { {m.name: m.about for m in status.modes if m.flown} }",
        f"SWITCH_MODES = { {m.letter: m.name for m in status.modes if m.switch} }",
        f"SWITCH_POSITIONS = {positions}",
        f"VETOES = {tuple(each.text for each in status.bits['vetoes'])}",
        f"RESET_CAUSES = { {each.bit: each.text for each in status.bits['reset_cause']} }",
        f"REASONS = { {each.code: each.text for each in status.refusals} }",
        *enum("Reason(IntEnum)", [(each.name, each.code) for each in status.refusals]),
        *enum("Veto(IntFlag)", bits("vetoes")), *enum("Reset(IntFlag)", bits("reset_cause")),
        *enum("Flag(IntFlag)", bits("flags")), "", "", "DATA = (",
        *(call("Datum", r, r.kind, r.unit, r.about, r.in_telemetry, r.signal)
          for r in status.rows),
        ")", "ALARMS = (",
        *(call("Alarm", r, a.kind, none(a.when), none(a.above), a.level, a.armed, a.code, a.text,
               a.end_code, a.end, a.event, a.unless, a.lasts, none(a.hold_s), r.finding)
          for r, a in status.alarms),
        ")", "", "", "@dataclass(frozen=True, slots=True)", "class BoardStatus:",
        '    """The fields of the status message, in the order of the wire."""', "",
        *(f"    {r.name}: int = value(minimum=0, maximum={MAXIMUM[r.type]}, unit={r.unit!r})"
          for r in status.fields),
        "", "    @property", "    def mode_letter(self) -> str:",
        '        """Return the letter of the flight mode."""', "        return chr(self.mode)",
        *(f"\n    @property\n    def is_{r.name}(self) -> bool:\n"
          f'        """Return whether {r.about}."""\n'
          f"        return bool(self.{r.field} & {1 << r.bit})"
          for r in status.rows if r.has_property), "",
    ])  # fmt: skip


def javascript(status: Status) -> str:
    """Return the page's module: flight modes, and the rows of the board panel."""
    modes = {mode.name: {"about": mode.about, "holder": mode.holder} for mode in status.modes}
    rows = []
    for each in (each for each in status.rows if each.row):
        style = next((key for key in ("alarm", "warning") if key in each.row), "")
        rows.append({
            "label": each.row["label"], "path": f"arduino.{each.name}", "kind": each.kind,
            "unit": each.unit, "yes": each.row.get("yes", "yes"), "no": each.row.get("no", "no"),
            "style": style, "when": each.row.get(style),
        })  # fmt: skip
    return (
        f"// {NOTE}\n\n/** Effect and holder of each flight mode. */\nexport const MODES = "
        f"{json.dumps(modes, indent=2)};\n\n/** Rows of the board panel; `style` applies to the"
        f" value `when`. */\nexport const BOARD_ROWS = {json.dumps(rows, indent=2)};\n"
    )


def java(status: Status) -> str:
    """Return the app's tables: events and alarms of the board, and units."""
    alarms = ",\n".join(
        f"            new BoardAlarm("
        f"{'Alarm.Kind.' + alarm.kind.upper() if alarm.lasts else 'null'},"
        f" {str(bool(alarm.event)).lower()},\n"
        f"                    {_java(f'arduino.{row.name}')},"
        f" {'null' if alarm.when == '' else 'Boolean.' + str(alarm.when).upper()},"
        f" {float(alarm.above or 0)}, {_java(alarm.unless and f'arduino.{alarm.unless}')},\n"
        f"                    EventLevel.{alarm.level.upper()},"
        f" EventLevel.{alarm.armed.upper()},\n"
        f"                    {_java(alarm.code, alarm.text)},\n"
        f"                    {_java(alarm.end_code, alarm.end)},"
        f" {round((alarm.hold_s or status.alarm_hold_s) * 1000)})"
        for row, alarm in status.alarms
        if alarm.text
    )
    units = "".join(
        f"        UNITS.put({_java(f'arduino.{each.name}', each.unit)});\n"
        for each in status.rows
        if each.in_telemetry and each.unit
    )
    imports = "".join(
        f"import java.util.{each};\n"
        for each in ("Arrays", "Collections", "HashMap", "List", "Map")
    )
    return f"""package org.raspilot.up.ground;

{imports}
/** Tables of the board's status.
 *  {NOTE} */
final class BoardSchema {{
    /** Time for which an alarm outlasts its condition, ms. */
    static final long ALARM_HOLD_MS = {round(status.alarm_hold_s * 1000)};
    /** Events and alarms. */
    static final List<BoardAlarm> ALARMS = Collections.unmodifiableList(Arrays.asList(
{alarms}));
    /** Units by path in telemetry. */
    static final Map<String, String> UNITS = new HashMap<String, String>();

    static {{
{units}    }}

    private BoardSchema() {{
    }}
}}
"""


def _java(*texts: str) -> str:
    return ", ".join(json.dumps(each) for each in texts)


def java_kinds(status: Status, text: str) -> str:
    """Return Alarm.java with a kind for each alarm of the board."""
    kinds = [
        f"        /** {alarm.text[0].upper()}{alarm.text[1:]}. */\n        {alarm.kind.upper()},\n"
        for _, alarm in status.alarms
        if alarm.lasts
    ]
    return _region(text, "".join(kinds), "// schema begin", "// schema end")


def documents(status: Status, text: str) -> str:
    """Return docs/protocols.md with the tables of modes, refusals, status and alarms."""
    tables = {
        "modes": [("letter", "mode", ""), *((f"`{m.letter}`", m.name, m.about)
                                            for m in status.modes if m.flown)],
        "refusals": [("code", "name", "reason"), *((r.code, f"`{r.name}`", r.text)
                                                   for r in status.refusals)],
        "status": [("offset", "type", "field", ""), *map(_field_row, status.fields)],
        "alarms": [("condition", "level", "code", "text", "when it is over"),
                   *(_alarm_row(*each) for each in status.alarms if each[1].text)],
    }  # fmt: skip
    for name, (head, *rows) in tables.items():
        lines = [head, ("---",) * len(head), *rows]
        content = "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)
        text = _region(text, content, f"<!-- schema {name} begin -->", "<!-- schema end -->")
    text = re.sub(r"(?m)^(\| `x` \| 78 \| )\d+", rf"\g<1>{status.size}", text)
    names = ", ".join(f"`{each.name}`" for each in status.rows if each.in_telemetry)
    line = f"| `arduino.<field>` | as in 2.7 | of the Arduino's status: {names} |"
    return re.sub(r"(?m)^\| `arduino\.<field>`.*$", line, text)


def _field_row(row: Item) -> tuple[Any, ...]:
    items = [f"{code} {text}" for code, text in row.values.items()]
    items += [f"bit {b.bit} `{b.name}`: {b.about or b.text}" for b in row.bits if b.firmware]
    about = row.about + (f", {row.unit}" if row.unit else "")
    return row.offset, row.type, f"`{row.name}`", about + (": " + "; ".join(items)) * bool(items)


def _alarm_row(row: Item, alarm: Item) -> tuple[Any, ...]:
    limit = f" above {alarm.above:g}" if alarm.above != "" else "" if alarm.when else " is false"
    hidden = f", not `arduino.{alarm.unless}`" if alarm.unless else ""
    level = alarm.level + (f", {alarm.armed} while armed" if alarm.armed != alarm.level else "")
    level += "" if alarm.lasts else " (event only)"
    return (
        f"`arduino.{row.name}`{limit}{hidden}",
        level,
        f"`{alarm.code}`",
        alarm.text,
        alarm.end or "-",
    )


def _region(text: str, content: str, begin: str, end: str) -> str:
    pattern = re.compile(f"({re.escape(begin)}\n).*?([ \t]*{re.escape(end)})", re.DOTALL)
    if not pattern.search(text):
        raise SchemaError(f"no region between '{begin}' and '{end}'")
    return pattern.sub(lambda found: found[1] + content + found[2], text, count=1)


OUTPUTS: dict[str, Callable[[Status, str], str]] = {
    "arduino/raspilot/src/core/status_schema.h": lambda status, _: cpp(status),
    "up/commands/board_schema.py": lambda status, _: python(status),
    "ground/up_ground/web/static/js/state/board_schema.js": lambda status, _: javascript(status),
    "android/core/src/org/raspilot/up/ground/BoardSchema.java": lambda status, _: java(status),
    "android/core/src/org/raspilot/up/ground/Alarm.java": java_kinds,
    "docs/protocols.md": documents,
}


def outdated(root: Path) -> Iterator[tuple[Path, str]]:
    """Yield each output that differs from the definition, with its new content."""
    status = Status(root / SOURCE)
    for name, make in OUTPUTS.items():
        path = root / name
        before = path.read_text(encoding="utf-8") if path.exists() else ""
        if (after := make(status, before)) != before:
            yield path, after


def main(arguments: list[str] | None = None) -> int:
    """Write or check every output; return 1 if one differs or the definition is invalid."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail on a difference")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    options = parser.parse_args(arguments)
    try:
        stale = list(outdated(options.root))
    except SchemaError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    for path, content in stale:
        if options.check:
            sys.stderr.write(f"{path} differs from {SOURCE}: run make schema\n")
        else:
            path.write_text(content, encoding="utf-8")
            sys.stdout.write(f"{path}: written\n")
    return int(bool(stale) and options.check)


if __name__ == "__main__":
    sys.exit(main())
