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
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

SOURCE = "schema/status.yml"
NOTE = f"Generated from {SOURCE} by tools/schema.py; do not edit."
WIDTH = 100
FORMATS = {"u8": "B", "u16": "H"}
LANES = {"u8": "uint8_t", "u16": "uint16_t"}


class SchemaError(Exception):
    """The definition is invalid; the text names file and row."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Alarm:
    """The condition of an event or alarm, and its texts."""

    kind: str = ""
    when: bool | None = None
    above: float | None = None
    level: str = "warning"
    armed: str = ""
    text: str = ""
    end: str = ""
    event: str = "source"
    unless: str = ""
    lasts: bool = True
    hold_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A field of the status, or a bit of one."""

    name: str
    type: str = ""
    bit: int | None = None
    about: str = ""
    unit: str = ""
    text: str = ""
    values: dict[int, str] = field(default_factory=dict)
    bits: tuple[Row, ...] = ()
    telemetry: bool | str = True
    signal: str | bool = True
    firmware: bool = True
    row: dict[str, Any] | None = None
    alarm: Alarm | None = None
    finding: str | bool = ""

    @property
    def kind(self) -> str:
        """Return the kind of its value in telemetry: flag, number or text."""
        if self.bit is not None:
            return "flag"
        return "text" if self.bits or self.values else "number"

    @property
    def is_datum(self) -> bool:
        """Whether it is a separate value: other bits with a text are items of a list."""
        return not self.bits and (not self.text or self.row is not None)

    @property
    def is_told(self) -> bool:
        """Whether telemetry contains it."""
        return self.telemetry == "text" or bool(self.telemetry and self.is_datum)


@dataclass(frozen=True, slots=True, kw_only=True)
class Mode:
    """A flight mode; ``switch``: a position of the switch selects it, ``flown``: it is reported."""

    letter: str
    name: str
    about: str
    holder: str = ""
    switch: bool = False
    flown: bool = True
    firmware: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """A code of ``!``."""

    code: int
    name: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Status:
    """Everything that the file defines."""

    version: int
    alarm_hold_s: float
    modes: tuple[Mode, ...]
    refusals: tuple[Refusal, ...]
    fields: tuple[Row, ...]

    @property
    def format(self) -> str:
        """Return the message as a format of ``struct``."""
        return ">" + "".join(FORMATS[each.type] for each in self.fields)

    @property
    def size(self) -> int:
        """Return the size of the message in bytes."""
        return struct.calcsize(self.format)

    def offsets(self) -> Iterator[tuple[int, Row]]:
        """Yield each field with its offset in the message."""
        offset = 0
        for each in self.fields:
            yield offset, each
            offset += struct.calcsize(FORMATS[each.type])

    def data(self) -> Iterator[tuple[str, Row]]:
        """Yield each datum with the name of its field, bits after their field."""
        for each in self.fields:
            yield each.name, each
            for bit in each.bits:
                yield each.name, bit

    def alarms(self) -> Iterator[tuple[str, Row, Alarm]]:
        """Yield each row with an alarm, with the name of its field."""
        for name, row in self.data():
            if row.alarm is not None:
                yield name, row, row.alarm

    def field(self, name: str) -> Row:
        """Return the field of a name."""
        return next(each for each in self.fields if each.name == name)


def read(path: Path) -> Status:
    """Return the definition; raises SchemaError."""

    def build(kind: Callable[..., Any], data: dict[str, Any], place: str) -> Any:
        try:
            return kind(**data)
        except TypeError as error:
            raise SchemaError(f"{path}: {place}: {str(error).partition(') ')[2]}") from None

    def row(data: dict[str, Any]) -> Row:
        place = str(data.get("name", data))
        data = dict(data, bits=tuple(row(each) for each in data.get("bits", ())))
        if "alarm" in data:
            alarm = {"kind": place, **data["alarm"]}
            data["alarm"] = build(Alarm, alarm, f"{place}: alarm")
            if (data["alarm"].when is None) == (data["alarm"].above is None):
                raise SchemaError(f"{path}: {place}: alarm: give either 'when' or 'above'")
        made: Row = build(Row, data, place)
        if (made.type not in FORMATS) == (made.bit is None):
            raise SchemaError(f"{path}: {place}: type must be one of {', '.join(FORMATS)}")
        return made

    try:
        data = yaml.safe_load(path.read_text(encoding="utf-8"))
        return Status(
            version=data["version"],
            alarm_hold_s=data["alarm_hold_s"],
            modes=tuple(build(Mode, each, "modes") for each in data["modes"]),
            refusals=tuple(build(Refusal, each, "refusals") for each in data["refusals"]),
            fields=tuple(row(each) for each in data["fields"]),
        )
    except (yaml.YAMLError, KeyError, OSError) as error:
        raise SchemaError(f"{path}: {error}") from None


def cpp(status: Status) -> str:
    """Return the firmware's header: offsets, bits and codes."""

    def enum(head: str, about: str, rows: list[tuple[str, object]]) -> list[str]:
        items = ",\n".join(f"  {name} = {number}" for name, number in rows)
        return [f"/** {about} */", f"enum {head} {{", items, "};", ""]

    def bits(prefix: str, name: str) -> list[tuple[str, object]]:
        rows = status.field(name).bits
        return [(f"{prefix}_{row.name.upper()}", 1 << row.bit) for row in rows if row.firmware]  # type: ignore[operator]

    modes = [(mode.name, f"'{mode.letter}'") for mode in status.modes if mode.flown]
    modes = [each for each in modes if each[0] in {m.name for m in status.modes if m.firmware}]
    refusals: list[tuple[str, object]] = [("NONE", 0)]
    refusals += [(each.name.upper(), each.code) for each in status.refusals]
    lines = [
        *("/** Codes of the serial line and layout of the status message.", f" *  {NOTE} */"),
        *("#pragma once", "", "#include <stdint.h>", "", "namespace raspilot {", ""),
        f"constexpr uint8_t PROTOCOL_VERSION = {status.version};",
        f"constexpr uint8_t STATUS_SIZE = {status.size};",
        "",
        *enum("class Mode : char", "Flight modes by their letter on the wire.", [*modes]),
        *enum("class Reason : uint8_t", "Refusals of a Command; NONE: carried out.", refusals),
        *enum("Veto : uint8_t", "Veto bits of the status.", bits("VETO", "vetoes")),
        *enum("ResetCause : uint8_t", "Reset cause bits of the status.",
              bits("RESET", "reset_cause")),
        *enum("StatusFlag : uint8_t", "Flags of the status.", bits("FLAG", "flags")),
        *enum("StatusOffset : uint8_t", "Offsets of the status's fields, big-endian.",
              [(f"AT_{each.name.upper()}", offset) for offset, each in status.offsets()]),
        "}  // namespace raspilot",
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def python(status: Status) -> str:
    """Return the module of tables for cog, flight log, ground station and simulator."""

    def flags(name: str, about: str, of: str) -> list[str]:
        rows = [(row.name.upper(), 1 << (row.bit or 0)) for row in status.field(of).bits]
        items = [f"    {key} = {bit}" for key, bit in rows]
        return ["", "", f"class {name}(IntFlag):", f'    """{about}"""', "", *items]

    switch = {mode.letter: mode.name for mode in status.modes if mode.switch}
    flown = {mode.letter: mode.name for mode in status.modes if mode.flown}
    known = {code: text for code, text in status.field("switch").values.items() if code != 255}
    causes = {row.bit: row.text for row in status.field("reset_cause").bits}
    lines = [
        f'"""Codes, fields and alarms of the board\'s status. {NOTE}"""',
        "# ruff: noqa: E501",
        "# fmt: off",
        PYTHON_HEAD,
        f"VERSION = {status.version}",
        f"STATUS = Struct({status.format!r})",
        f"ALARM_HOLD_S = {status.alarm_hold_s}",
        f"FLIGHT_MODES = {flown!r}",
        f"SWITCH_MODES = {switch!r}",
        f"SWITCH_POSITIONS = {known!r}",
        f"VETOES = {tuple(row.text for row in status.field('vetoes').bits)!r}",
        f"RESET_CAUSES = {causes!r}",
        *flags("Veto", "Bits of vetoes.", "vetoes"),
        *flags("Reset", "Bits of the reset cause.", "reset_cause"),
        *flags("Flag", "Bits of flags.", "flags"),
        *("", "", "class Reason(IntEnum):", '    """Codes of a refusal (`!`)."""', ""),
        *(f"    {each.name.upper()} = {each.code}" for each in status.refusals),
        *("", "", "REASONS = {"),
        *(f"    {each.code}: {each.text!r}," for each in status.refusals),
        "}",
        "DATA = (",
    ]
    for name, row in status.data():
        signal = row.name if row.signal is True else (row.signal or "")
        signal = signal if row.is_datum else ""
        datum = (row.name, name, row.bit, row.kind, row.unit, row.about, row.is_told, signal)
        lines.append(f"    Datum{datum!r},")
    lines += [")", "ALARMS = ("]
    for name, row, alarm in status.alarms():
        finding = row.finding if row.finding or row.finding is False else alarm.text
        made = (
            *(row.name, name, row.bit, alarm.kind, alarm.when, alarm.above, alarm.level),
            *(alarm.armed or alarm.level, alarm.text, alarm.end, alarm.event, alarm.unless),
            *(alarm.lasts, alarm.hold_s, finding or ""),
        )
        lines.append(f"    Alarm{made!r},")
    lines += [")", "", "", "@dataclass(frozen=True, slots=True)", "class BoardStatus:"]
    lines += ['    """The fields of the status message, in the order of the wire."""', ""]
    for each in status.fields:
        most = 2 ** (8 * struct.calcsize(FORMATS[each.type])) - 1
        unit = f", unit={each.unit!r}" if each.unit else ""
        lines.append(f"    {each.name}: int = value(minimum=0, maximum={most}{unit})")
    lines += ["", "    @property", "    def mode_letter(self) -> str:"]
    lines += [
        '        """Return the letter of the flight mode."""',
        "        return chr(self.mode)",
    ]
    for name, row in status.data():
        if row.bit is not None and row.is_datum:
            lines += ["", "    @property", f"    def is_{row.name}(self) -> bool:"]
            lines += [f'        """Return whether {row.about}."""']
            lines += [f"        return bool(self.{name} & {1 << row.bit})"]
    return "\n".join(lines) + "\n"


PYTHON_HEAD = '''
from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, IntFlag
from struct import Struct
from typing import Literal, NamedTuple

from up.commands.command import value


class Datum(NamedTuple):
    """A field of the status, or a bit of one; ``signal`` is the scenarios' name for it."""

    name: str
    field: str
    bit: int | None
    kind: Literal["flag", "number", "text"]
    unit: str
    about: str
    in_telemetry: bool
    signal: str


class Alarm(NamedTuple):
    """A condition of ``arduino.<name>`` in telemetry that is an event, an alarm or a finding."""

    name: str
    field: str
    bit: int | None
    kind: str
    when: bool | None
    above: float | None
    level: str
    level_armed: str
    text: str
    end: str
    event: str
    unless: str
    lasts: bool
    hold_s: float | None
    finding: str

    def holds(self, value: float | bool | None) -> bool | None:
        """Return whether a value fulfils the condition; None if it is unknown."""
        if value is None:
            return None
        return value is self.when if self.above is None else value > self.above

'''


def javascript(status: Status) -> str:
    """Return the page's module: flight modes, and the rows of the board panel."""
    modes = {mode.name: {"about": mode.about, "holder": mode.holder} for mode in status.modes}
    rows = []
    for _, each in status.data():
        if each.row is None:
            continue
        style = next((key for key in ("alarm", "warning") if key in each.row), "")
        rows.append({
            "label": each.row["label"], "path": f"arduino.{each.name}", "kind": each.kind,
            "unit": each.unit, "yes": each.row.get("yes", "yes"), "no": each.row.get("no", "no"),
            "style": style, "when": each.row.get(style),
        })  # fmt: skip
    return (
        f"// {NOTE}\n\n/** Effect and holder of each flight mode. */\nexport const MODES = "
        f"{_js(modes)};\n\n/** Rows of the board panel; `style` applies to the value `when`. */\n"
        f"export const BOARD_ROWS = {_js(rows)};\n"
    )


def _js(value: dict[str, Any] | list[Any]) -> str:
    """Return JavaScript with one row a line, split if it is too long."""

    def plain(item: Any) -> str:
        if isinstance(item, dict):
            return "{ " + ", ".join(f"{key}: {plain(each)}" for key, each in item.items()) + " }"
        return json.dumps(item)

    is_map = isinstance(value, dict)
    pairs = value.items() if isinstance(value, dict) else enumerate(value)
    lines = []
    for key, item in pairs:
        head = f"  {key}: " if is_map else "  "
        line = f"{head}{plain(item)},"
        if len(line) > WIDTH:
            inner = "".join(f"    {name}: {plain(each)},\n" for name, each in item.items())
            line = f"{head}{{\n{inner}  }},"
        lines.append(line)
    opening, closing = ("{", "}") if is_map else ("[", "]")
    return "\n".join([opening, *lines, closing])


def java(status: Status) -> str:
    """Return the app's tables: events and alarms of the board, and units."""
    lines = [
        "package org.raspilot.up.ground;",
        *("", "import java.util.Arrays;", "import java.util.Collections;"),
        *("import java.util.HashMap;", "import java.util.List;", "import java.util.Map;", ""),
        "/** Tables of the board's status.",
        f" *  {NOTE} */",
        "final class BoardSchema {",
        "    /** Time for which an alarm outlasts its condition, ms. */",
        f"    static final long ALARM_HOLD_MS = {round(status.alarm_hold_s * 1000)};",
        "    /** Events and alarms. */",
        "    static final List<BoardAlarm> ALARMS = Collections.unmodifiableList(Arrays.asList(",
    ]
    rows = []
    for _, row, alarm in status.alarms():
        if not alarm.text:
            continue
        kind = f"Alarm.Kind.{alarm.kind.upper()}" if alarm.lasts else "null"
        condition = f"Boolean.{str(alarm.when).upper()}" if alarm.above is None else "null"
        hold_s = status.alarm_hold_s if alarm.hold_s is None else alarm.hold_s
        rows.append(
            f'            new BoardAlarm("{alarm.kind}", "{alarm.event}", {kind},\n'
            f'                    "arduino.{row.name}", {condition}, {alarm.above or 0.0},'
            f" {json.dumps(alarm.unless and f'arduino.{alarm.unless}')},\n"
            f"                    EventLevel.{alarm.level.upper()},"
            f" EventLevel.{(alarm.armed or alarm.level).upper()},\n"
            f"                    {json.dumps(alarm.text)},\n"
            f"                    {json.dumps(alarm.end)}, {round(hold_s * 1000)})"
        )
    lines += [",\n".join(rows) + "));", "    /** Units by path in telemetry. */"]
    lines += ["    static final Map<String, String> UNITS = new HashMap<String, String>();", ""]
    lines += ["    static {"]
    for _, row in status.data():
        if row.is_told and row.unit:
            lines.append(f'        UNITS.put("arduino.{row.name}", "{row.unit}");')
    lines += ["    }", "", "    private BoardSchema() {", "    }", "}"]
    return "\n".join(lines) + "\n"


def java_kinds(status: Status, text: str) -> str:
    """Return Alarm.java with a kind for each alarm of the board."""
    kinds = [
        f"        /** {alarm.text[0].upper()}{alarm.text[1:]}. */\n        {alarm.kind.upper()},\n"
        for _, _, alarm in status.alarms()
        if alarm.lasts
    ]
    return _region(text, "".join(kinds), "// schema begin", "// schema end")


def documents(status: Status, text: str) -> str:
    """Return docs/protocols.md with the tables of modes, refusals and status."""
    modes = ["| letter | mode | |", "|---|---|---|"]
    modes += [f"| `{m.letter}` | {m.name} | {m.about} |" for m in status.modes if m.flown]
    refusals = ["| code | name | reason |", "|---|---|---|"]
    refusals += [f"| {each.code} | `{each.name}` | {each.text} |" for each in status.refusals]
    fields = ["| offset | type | field | |", "|---|---|---|---|"]
    for offset, row in status.offsets():
        unit = f", {row.unit}" if row.unit else ""
        about = row.about + unit
        values = [f"{code} {text}" for code, text in row.values.items()]
        bits = [f"bit {b.bit} `{b.name}`: {b.about or b.text}" for b in row.bits if b.firmware]
        if values or bits:
            about += ": " + "; ".join(values + bits)
        fields.append(f"| {offset} | {row.type} | `{row.name}` | {about} |")
    alarms = ["| condition | level | text | when it is over |", "|---|---|---|---|"]
    for _, row, alarm in status.alarms():
        if alarm.text:
            limit = alarm.above is None and ("" if alarm.when else " is false")
            hides = f", not `arduino.{alarm.unless}`" if alarm.unless else ""
            condition = f"`arduino.{row.name}`{limit or ''}" + (
                f" above {alarm.above:g}" if alarm.above is not None else ""
            )
            armed = f", {alarm.armed} while armed" if alarm.armed else ""
            level = f"{alarm.level}{armed}" + ("" if alarm.lasts else " (event only)")
            alarms.append(f"| {condition}{hides} | {level} | {alarm.text} | {alarm.end or '-'} |")
    for name, table in (
        *(("modes", modes), ("refusals", refusals), ("status", fields), ("alarms", alarms)),
    ):
        content = "\n".join(table) + "\n"
        text = _region(text, content, f"<!-- schema {name} begin -->", "<!-- schema end -->")
    text = re.sub(r"(?m)^(\| `x` \| 78 \| )\d+", rf"\g<1>{status.size}", text)
    told = ", ".join(f"`{row.name}`" for _, row in status.data() if row.is_told)
    line = f"| `arduino.<field>` | as in 2.7 | of the Arduino's status: {told} |"
    return re.sub(r"(?m)^\| `arduino\.<field>`.*$", line, text)


def _region(text: str, content: str, begin: str, end: str) -> str:
    head, marker, rest = text.partition(begin + "\n")
    before, closing, tail = rest.partition(end)
    if not (marker and closing):
        raise SchemaError(f"no region between '{begin}' and '{end}'")
    indent = re.search(r"[ \t]*\Z", before)
    return head + marker + content + (indent.group() if indent else "") + closing + tail


OUTPUTS: dict[str, Callable[[Status, str], str]] = {
    "arduino/raspilot/src/core/status_schema.h": lambda status, _: cpp(status),
    "up/commands/board_schema.py": lambda status, _: python(status),
    "ground/up_ground/web/static/js/state/board_schema.js": lambda status, _: javascript(status),
    "android/core/src/org/raspilot/up/ground/BoardSchema.java": lambda status, _: java(status),
    "android/core/src/org/raspilot/up/ground/Alarm.java": java_kinds,
    "docs/protocols.md": documents,
}


def main(arguments: list[str] | None = None) -> int:
    """Write or check every output; return 1 if one differs or the schema is invalid."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail on a difference")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    options = parser.parse_args(arguments)
    stale = []
    try:
        status = read(options.root / SOURCE)
        for name, make in OUTPUTS.items():
            path = options.root / name
            before = path.read_text(encoding="utf-8") if path.exists() else ""
            after = make(status, before)
            if after != before:
                stale.append(name)
                if not options.check:
                    path.write_text(after, encoding="utf-8")
    except SchemaError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    for name in stale:
        sys.stdout.write(f"{name}: {'differs from ' + SOURCE if options.check else 'written'}\n")
    if stale and options.check:
        sys.stderr.write("run tools/schema.py\n")
    return int(bool(stale) and options.check)


if __name__ == "__main__":
    sys.exit(main())
