#!/usr/bin/env python3
"""Writes the tables that schema/ and the Commands define, in every language: ``tools/schema.py``.

``--check`` writes nothing and fails if a table differs; ``--root FOLDER`` works on another tree;
``--json FOLDER`` writes the JSON Schema of every Command, telemetry included.
"""

from __future__ import annotations

import argparse
import importlib
import json
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))  # A program finds only the modules of its own folder.

from tools.schema_definition import (  # noqa: E402
    MAXIMUM,
    TYPES,
    Item,
    Schema,
    SchemaError,
    event_rule,
)

NOTE = "Generated from schema/{} by tools/schema.py; do not edit."
BOARD_NOTE = NOTE.format("status.yml")
TELEMETRY_NOTE = NOTE.format("{telemetry,events,status}.yml")


def cpp(schema: Schema) -> str:
    """Return the firmware's header: offsets, bits and codes."""

    def enum(head: str, about: str, rows: list[tuple[str, Any]]) -> str:
        items = ",\n".join(f"  {name} = {number}" for name, number in rows)
        return f"/** {about} */\nenum {head} {{\n{items}\n}};\n\n"

    def bits(prefix: str, field: str) -> list[tuple[str, Any]]:
        rows = (each for each in schema.bits[field] if each.firmware)
        return [(f"{prefix}_{each.name.upper()}", 1 << each.bit) for each in rows]

    modes = [(m.name, f"'{m.letter}'") for m in schema.modes if m.flown and m.firmware]
    refusals = [(each.name.upper(), each.code) for each in schema.refusals]
    offsets = [(f"AT_{each.name.upper()}", each.offset) for each in schema.status]
    return (
        f"/** Codes of the serial line and layout of the status message.\n *  {BOARD_NOTE} */\n"
        "#pragma once\n\n#include <stdint.h>\n\nnamespace raspilot {\n\n"
        f"constexpr uint8_t PROTOCOL_VERSION = {schema.version};\n"
        f"constexpr uint8_t STATUS_SIZE = {schema.size};\n\n"
        + enum("class Mode : char", "Flight modes by their letter on the wire.", modes)
        + enum("class Reason : uint8_t", "Refusals of a Command.", [("NONE", 0), *refusals])
        + enum("Veto : uint8_t", "Veto bits of the status.", bits("VETO", "vetoes"))
        + enum("ResetCause : uint8_t", "Reset cause bits.", bits("RESET", "reset_cause"))
        + enum("StatusFlag : uint8_t", "Flags of the status.", bits("FLAG", "flags"))
        + enum("StatusOffset : uint8_t", "Offsets of the fields, big-endian.", offsets)
        + "}  // namespace raspilot\n"
    )


def python(schema: Schema) -> str:
    """Return the module of the status for cog, flight log, ground station and simulator."""

    def enum(head: str, rows: list[tuple[str, int]]) -> list[str]:
        return ["", "", f"class {head}:", *(f"    {name.upper()} = {code}" for name, code in rows)]

    def bits(field: str) -> list[tuple[str, int]]:
        return [(each.name, 1 << each.bit) for each in schema.bits[field]]

    def datum(row: Item) -> str:
        bit = None if row.bit == "" else row.bit
        more = (row.kind, row.unit, row.about, row.in_telemetry, row.signal)
        return f"    Datum{(row.name, row.field, bit, *more)!r},"

    positions = {k: v for r in schema.status if r.name == "switch" for k, v in r.values.items()}
    positions.pop(255)
    return "\n".join([
        f'"""Codes and fields of the board\'s status. {BOARD_NOTE}"""',
        "# ruff: noqa: D101, E501, RUF100", "# fmt: off", "",
        "from __future__ import annotations", "", "from dataclasses import dataclass",
        "from enum import IntEnum, IntFlag", "from struct import Struct", "",
        "from up.commands.command import value",
        "from up.commands.schema_rows import Datum", "",
        f"VERSION = {schema.version}", f"STATUS = Struct({schema.format!r})",
        f"FLIGHT_MODES = { {m.letter: m.name for m in schema.modes if m.flown} }",
        f"MODE_TEXTS = { {m.name: m.about for m in schema.modes if m.flown} }",
        f"SWITCH_MODES = { {m.letter: m.name for m in schema.modes if m.switch} }",
        f"SWITCH_POSITIONS = {positions}",
        f"VETOES = {tuple(each.text for each in schema.bits['vetoes'])}",
        f"RESET_CAUSES = { {each.bit: each.text for each in schema.bits['reset_cause']} }",
        f"REASONS = { {each.code: each.text for each in schema.refusals} }",
        *enum("Reason(IntEnum)", [(each.name, each.code) for each in schema.refusals]),
        *enum("Veto(IntFlag)", bits("vetoes")), *enum("Reset(IntFlag)", bits("reset_cause")),
        *enum("Flag(IntFlag)", bits("flags")), "", "", "DATA = (",
        *(datum(r) for r in schema.rows),
        ")", "", "", "@dataclass(frozen=True, slots=True)", "class BoardStatus:",
        '    """The fields of the status message, in the order of the wire."""', "",
        *(f"    {r.name}: int = value(minimum=0, maximum={MAXIMUM[r.type]}, unit={r.unit!r})"
          for r in schema.status),
        "", "    @property", "    def mode_letter(self) -> str:",
        '        """Return the letter of the flight mode."""', "        return chr(self.mode)",
        *(f"\n    @property\n    def is_{r.name}(self) -> bool:\n"
          f'        """Return whether {r.about}."""\n'
          f"        return bool(self.{r.field} & {1 << r.bit})"
          for r in schema.rows if r.has_property), "",
    ])  # fmt: skip


def python_telemetry(schema: Schema) -> str:
    """Return the module of telemetry for flight log, ground station and simulator."""

    def rows(kind: str, items: list[dict[str, Any]]) -> list[str]:
        columns = [", ".join(f"{key}={value!r}" for key, value in each.items()) for each in items]
        return [f"    {kind}({each})," for each in columns]

    def field(row: Item) -> dict[str, Any]:
        names = ("type", "unit", "reading")
        known = {key: getattr(row, key) for key in names if getattr(row, key)}
        command = getattr(row, "from")
        return {
            "path": row.name,
            **known,
            **({"command": command, "key": row.key} if command else {}),
        }

    events = (f"    {each.code!r}: {text}" for each in schema.events
              for text in rows("Rule", [_given(event_rule(each))]))  # fmt: skip
    return "\n".join([
        f'"""Fields, ages, events and alarms of telemetry. {TELEMETRY_NOTE}"""',
        "# ruff: noqa: E501, RUF100", "# fmt: off", "", "from typing import Any", "",
        "from up.commands.schema_rows import Field, Reading, Rule", "",
        *(f"{name.upper()} = {value!r}" for name, value in schema.times.items()
          if name != "hold_s"),
        "READINGS = {",
        *(f"    {r.name!r}: Reading(stale_s={r.stale_s}, source_s={r.source_s}),"
          for r in schema.readings),
        "}", "FIELDS = (", *rows("Field", [field(r) for r in schema.fields if r.in_telemetry]),
        ")", "RULES = (", *rows("Rule", [_given(rule) for rule in schema.rules]),
        ")", "EVENTS = {", *events, "}", f"ALARM_HOLDS_S = {schema.holds_s}",
        f"PROPERTIES: dict[str, Any] = {json_tree(schema)!r}", "",
    ])  # fmt: skip


def json_tree(schema: Schema) -> dict[str, Any]:
    """Return the JSON Schema of the fields of telemetry."""
    tree: dict[str, Any] = {}
    for each in (each for each in schema.fields if each.in_telemetry):
        *groups, name = each.name.split(".")
        branch = tree
        for group in groups:
            leaf = {"type": "object", "properties": {}, "nullable": True}
            branch = branch.setdefault(group, leaf)["properties"]
        more: dict[str, Any] = {"nullable": True}
        if each.type in ("texts", "object"):
            more = {"items": {"type": "string"}, **more} if each.type == "texts" else {}
            more |= {} if each.type == "texts" else {"properties": {}}
        if each.type == "number" and each.unit:
            more |= {"x-unit": each.unit, "description": each.unit}
        branch[name] = {"type": TYPES[each.type], **more}
    return tree


def _given(rule: dict[str, Any]) -> dict[str, Any]:
    """Return the columns of a rule that differ from their defaults."""
    return {key: value for key, value in rule.items()
            if key != "hold_s" and value != "" and (value or key == "when")}  # fmt: skip


def javascript(schema: Schema) -> str:
    """Return the page's module: flight modes, rows of the board panel, ages of readings."""
    rows = []
    for each in (each for each in schema.fields if each.row):
        style = next((key for key in ("alarm", "warning") if key in each.row), "")
        rows.append({
            "label": each.row["label"], "path": each.name, "kind": each.type,
            "unit": each.unit, "yes": each.row.get("yes", "yes"), "no": each.row.get("no", "no"),
            "style": style, "when": each.row.get(style),
        })  # fmt: skip
    tables = {
        "Effect and holder of each flight mode.": (
            "MODES", {mode.name: {"about": mode.about, "holder": mode.holder}
                      for mode in schema.modes}),
        "Rows of the board panel; `style` applies to the value `when`.": ("BOARD_ROWS", rows),
        "An older frame is shown as stale, before the second is over.": (
            "SILENT_S", schema.times["silent_s"]),
        "Two clocks run apart by no more than this.": ("DRIFT", schema.times["drift"]),
        "The readings with ages in telemetry; older ones are shown as stale.": (
            "READINGS", {each.name: {"title": each.title, "stale_s": each.stale_s}
                         for each in schema.readings}),
        "The reading whose age a field has.": (
            "READING_OF", {each.name: each.reading for each in schema.fields if each.reading}),
        "Limits of the alarms of numbers.": ("LIMITS", _limits(schema)),
    }  # fmt: skip
    return f"// {TELEMETRY_NOTE}\n" + "".join(
        f"\n/** {about} */\nexport const {name} = {json.dumps(value, indent=2)};\n"
        for about, (name, value) in tables.items()
    )


def _limits(schema: Schema) -> dict[str, float]:
    limits = ((rule["code"], rule.get("above", ""), rule.get("below", "")) for rule in schema.rules)
    return {code: above if above != "" else below
            for code, above, below in limits if above != below}  # fmt: skip


JAVA_TIMES = ("pause_s", "max_pause_s", "quiet_s", "silent_s", "new_clock_s")


def java(schema: Schema) -> str:
    """Return the app's tables: fields, ages, events and alarms of telemetry."""

    def put(table: str, key: str, value: object) -> str:
        return f"        {table}.put({json.dumps(key)}, {value});\n"

    def rule(columns: dict[str, Any]) -> str:
        texts = [(k, ",".join(v) if k == "awaits" else str(v).lower() if v in (True, False) else v)
                 for k, v in _given(columns).items() if k != "finding"]  # fmt: skip
        pairs = ",\n                ".join(
            f"{json.dumps(k)}, {json.dumps(str(v))}" for k, v in texts
        )
        return f"new TelemetryRule(\n                {pairs})"

    shown = [each for each in schema.rules if each["event"] or each["alarm"]]
    fields = [each for each in schema.fields if each.in_telemetry]
    imports = "".join(f"import java.util.{each};\n" for each in (
        "ArrayList", "HashMap", "LinkedHashMap", "List", "Map"))  # fmt: skip
    times = "".join(
        f"    static final {kind} {name} = {value};\n"
        for name, kind, value in (
            *((f"{key[:-2].upper()}_MS", "long", round(1000 * value))
              for key, value in schema.times.items() if key in JAVA_TIMES),
            ("DRIFT", "double", schema.times["drift"]),
        )
    )  # fmt: skip
    return f"""package org.raspilot.up.ground;

{imports}
/** Tables of telemetry.
 *  {TELEMETRY_NOTE} */
public final class TelemetrySchema {{
{times}    /** Maximum age of a reading that is not stale, ms. */
    static final Map<String, Long> STALE_MS = new LinkedHashMap<>();
    /** Times for which alarms outlast their conditions, ms, by kind in the order of display. */
    static final Map<String, Long> HOLDS_MS = new LinkedHashMap<>();
    /** The reading whose age a field has. */
    static final Map<String, String> READING_OF = new HashMap<>();
    static final Map<String, String> UNITS = new HashMap<>();
    /** Decimals of fields that have other than 3. */
    static final Map<String, Integer> DECIMALS = new HashMap<>();
    /** Limits of the alarms of numbers. */
    static final Map<String, Double> LIMITS = new HashMap<>();
    static final List<TelemetryRule> RULES = new ArrayList<>();
    /** Events without a field, by code. */
    static final Map<String, TelemetryRule> EVENTS = new HashMap<>();

    static {{
{"".join(put("STALE_MS", r.name, f"{round(1000 * r.stale_s)}L") for r in schema.readings)}\
{"".join(put("HOLDS_MS", k, f"{round(1000 * v)}L") for k, v in schema.holds_s.items())}\
{"".join(put("READING_OF", r.name, json.dumps(r.reading)) for r in fields if r.reading)}\
{"".join(put("UNITS", r.name, json.dumps(r.unit)) for r in fields if r.unit)}\
{"".join(put("DECIMALS", r.name, r.decimals) for r in fields if r.decimals != 3)}\
{"".join(put("LIMITS", k, float(v)) for k, v in _limits(schema).items())}\
{"".join(f"        RULES.add({rule(each)});" + chr(10) for each in shown)}\
{"".join(put("EVENTS", each.code, rule(event_rule(each))) for each in schema.events)}\
    }}

    private TelemetrySchema() {{
    }}
}}
"""


def documents(schema: Schema, text: str) -> str:
    """Return docs/protocols.md with the tables that the definitions determine."""
    tables: dict[str, list[Any]] = {
        "modes": [("letter", "mode", ""), *((f"`{m.letter}`", m.name, m.about)
                                            for m in schema.modes if m.flown)],
        "refusals": [("code", "name", "reason"), *((r.code, f"`{r.name}`", r.text)
                                                   for r in schema.refusals)],
        "answers": [("code", "meaning"), *((f"`{r.code}`", r.text) for r in schema.answers)],
        "commands": [("name", "who may send it", "fields", ""), *_commands().rows()],
        "status": [("offset", "type", "field", ""), *map(_status_row, schema.status)],
        "telemetry": [("field", "unit", "age of", "content"),
                      *(_field_row(each, schema) for each in schema.table)],
        "events": [("condition", "alarm", "level", "code", "text", "when it is over"),
                   *map(_event_row, [*map(event_rule, schema.events), *schema.rules])],
    }  # fmt: skip
    for name, (head, *rows) in tables.items():
        lines = [head, ("---",) * len(head), *filter(None, rows)]
        content = "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)
        text = _region(text, content, f"<!-- schema {name} begin -->", "<!-- schema end -->")
    return re.sub(r"(?m)^(\| `x` \| 78 \| )\d+", rf"\g<1>{schema.size}", text)


def _status_row(row: Item) -> tuple[Any, ...]:
    items = [f"{code} {text}" for code, text in row.values.items()]
    items += [f"bit {b.bit} `{b.name}`: {b.about or b.text}" for b in row.bits if b.firmware]
    about = row.about + (f", {row.unit}" if row.unit else "")
    return row.offset, row.type, f"`{row.name}`", about + (": " + "; ".join(items)) * bool(items)


def _field_row(row: Item, schema: Schema) -> tuple[Any, ...]:
    if row.type == "status":
        names = ", ".join(f"`{each.name}`" for each in schema.rows if each.in_telemetry)
        return (
            f"`{row.name}.<field>`",
            "as in 2.7",
            row.reading,
            f"of the Arduino's status: {names}",
        )
    name = row.name + "." * bool(row.of) + "/".join(row.of)
    unit = row.unit or {"number": "", "flag": "bool", "texts": "list of text"}.get(
        row.type, row.type
    )
    return f"`{name}`", unit, row.reading, row.about


def _event_row(rule: dict[str, Any]) -> tuple[Any, ...] | None:
    if not rule["event"] and not rule["alarm"]:
        return None
    path, when = f"`{rule.get('path', '')}`", rule.get("when", "")
    limits = [f" {word} {rule[word]:g}" for word in ("above", "below") if rule.get(word, "") != ""]
    change = "" if "when" in rule else " changes"
    condition = path + ("".join(limits) or change or ("" if when else " is false"))
    hidden = f", not `{rule['unless']}`" if rule.get("unless") else ""
    armed = rule.get("level_armed", rule["level"])
    level = rule["level"] + (f", {armed} while armed" if armed != rule["level"] else "")
    return (condition + hidden if "path" in rule else "link", rule["alarm"] or "-", level,
            f"`{rule['code']}`", rule["text"], rule.get("end") or "-")  # fmt: skip


def answer_codes(schema: Schema, text: str) -> str:
    """Return up/commands/refusal.py with its codes."""
    codes = "".join(f'    {each.code.upper()} = "{each.code}"\n' for each in schema.answers)
    return _region(text, codes, "    # schema begin", "    # schema end")


def java_answer_codes(schema: Schema, text: str) -> str:
    """Return NackCode.java with its codes."""
    codes = "".join(
        f"    /** {each.text[0].upper()}{each.text[1:]}. */\n    {each.code.upper()},\n"
        for each in schema.answers
    )
    return _region(text, codes, "// schema begin", "// schema end")


def _commands() -> Any:
    """Import the Commands, when the tables that their modules import are written."""
    try:
        return importlib.import_module("tools.command_tables")
    except ImportError as error:
        raise SchemaError(f"{error}: run tools/schema.py by make schema") from None


def _region(text: str, content: str, begin: str, end: str) -> str:
    pattern = re.compile(f"({re.escape(begin)}\n).*?([ \t]*{re.escape(end)})", re.DOTALL)
    if not pattern.search(text):
        raise SchemaError(f"no region between '{begin}' and '{end}'")
    return pattern.sub(lambda found: found[1] + content + found[2], text, count=1)


OUTPUTS: dict[str, Callable[[Schema, str], str]] = {
    "arduino/raspilot/src/core/status_schema.h": lambda schema, _: cpp(schema),
    "up/commands/board_schema.py": lambda schema, _: python(schema),
    "up/commands/telemetry_schema.py": lambda schema, _: python_telemetry(schema),
    "ground/up_ground/web/static/js/state/schema.js": lambda schema, _: javascript(schema),
    "android/core/src/org/raspilot/up/ground/TelemetrySchema.java": lambda schema, _: java(schema),
    "up/commands/refusal.py": answer_codes,
    "android/core/src/org/raspilot/up/commands/NackCode.java": java_answer_codes,
    "android/raspilot/assets/commands.json": lambda *_: _commands().forms(),
    "docs/protocols.md": documents,
}


def outdated(root: Path) -> Iterator[tuple[Path, str]]:
    """Yield each output that differs from the definitions, with its new content."""
    schema = Schema(root / "schema")
    for name, make in OUTPUTS.items():
        path = root / name
        before = path.read_text(encoding="utf-8") if path.exists() else ""
        if (after := make(schema, before)) != before:
            yield path, after


def main(arguments: list[str] | None = None) -> int:
    """Write or check every output; return 1 if one differs or a definition is invalid."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail on a difference")
    parser.add_argument("--root", type=Path, default=ROOT)
    parser.add_argument("--json", type=Path, metavar="FOLDER")
    options = parser.parse_args(arguments)
    stale = False
    try:
        if options.json:
            _commands().write_json_schemas(options.json)
            return 0
        for path, content in outdated(options.root):
            stale = True
            if options.check:
                sys.stderr.write(f"{path} differs from its definition: run make schema\n")
                continue
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content, encoding="utf-8")
            sys.stdout.write(f"{path}: written\n")
    except (SchemaError, ValueError, OSError) as error:
        sys.stderr.write(f"{error}\n")
        return 1
    return int(stale and options.check)


if __name__ == "__main__":
    sys.exit(main())
