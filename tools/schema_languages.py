"""The tables of schema/ in C++, Python, JavaScript and Java, for tools/schema.py."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from tools.schema_definition import (
    MAXIMUM,
    TYPES,
    Item,
    Schema,
    event_rule,
)

NOTE = "Generated from schema/{} by tools/schema.py; do not edit."
BOARD_NOTE = NOTE.format("status.yml")
TELEMETRY_NOTE = NOTE.format("{telemetry,events,status,commands}.yml")


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


def _pi_modes(schema: Schema) -> tuple[str, ...]:
    return tuple(mode.name for mode in schema.modes if mode.pi)


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
        "from __future__ import annotations", "",
        "from enum import IntEnum, IntFlag", "from struct import Struct", "",
        "from up.commands.command import value",
        "from up.commands.schema_rows import Datum",
        "from up.quick_dataclass import dataclass", "",
        f"VERSION = {schema.version}", f"STATUS = Struct({schema.format!r})",
        f"OLDEST_SIZE = {schema.oldest_size}",
        f"FLIGHT_MODES = { {m.letter: m.name for m in schema.modes if m.flown} }",
        f"MODE_TEXTS = { {m.name: m.about for m in schema.modes if m.flown} }",
        f"PI_MODES = {_pi_modes(schema)}",
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
            **({"decimals": row.decimals} if row.decimals != 3 else {}),
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
        f")\nMODE_REASONS = {schema.mode_reasons}", "EVENTS = {", *events, "}",
        f"OUTCOMES = { {each.code: (each.level, each.text) for each in schema.outcomes} }",
        f"ALARM_HOLDS_S = {schema.holds_s}",
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
    hidden = ("hold_s", "cure")
    return {key: value for key, value in rule.items()
            if key not in hidden and value != "" and (value or key == "when")}  # fmt: skip


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
                      for mode in schema.modes} | {
                          name: {"about": about, "holder": ""}
                          for name, about in schema.mode_texts.items()}),
        "The board's modes in which a mode of the Raspberry Pi flies.": (
            "PI_MODES", list(_pi_modes(schema))),
        "Rows of the board panel; `style` applies to the value `when`.": ("BOARD_ROWS", rows),
        "Rows of the navigation panel.": ("NAVIGATION_ROWS", [
            {"label": each.label, "path": each.name, "unit": each.unit, "decimals": each.decimals,
             "optional": each.optional}
            for each in schema.fields if each.label]),
        "Why a flight mode is not offered, or was replaced, by code.": (
            "MODE_REASONS", schema.mode_reasons),
        "An older frame is shown as stale, before the second is over.": (
            "SILENT_S", schema.times["silent_s"]),
        "Two clocks run apart by no more than this.": ("DRIFT", schema.times["drift"]),
        "The readings with ages in telemetry; older ones are shown as stale.": (
            "READINGS", {each.name: {"title": each.title, "stale_s": each.stale_s}
                         for each in schema.readings}),
        "The reading whose age a field has.": (
            "READING_OF", {each.name: each.reading for each in schema.fields if each.reading}),
        "Limits of the alarms of numbers.": ("LIMITS", _limits(schema)),
        "The outcomes of sent Commands.": (
            "OUTCOMES", {each.code: each.text for each in schema.outcomes}),
    }  # fmt: skip
    return f"// {TELEMETRY_NOTE}\n" + "".join(
        f"\n/** {about} */\nexport const {name} = {_javascript_rows(value)};\n"
        for about, (name, value) in tables.items()
    )


def _javascript_rows(value: Any) -> str:
    """Return a table with a line for each of its rows."""
    if isinstance(value, dict):
        rows = "".join(f"  {json.dumps(key)}: {json.dumps(each)},\n" for key, each in value.items())
        return f"{{\n{rows}}}"
    if isinstance(value, list):
        rows = "".join(f"  {json.dumps(each)},\n" for each in value)
        return f"[\n{rows}]"
    return json.dumps(value)


def _limits(schema: Schema) -> dict[str, float]:
    limits = ((rule["code"], rule.get("above", ""), rule.get("below", "")) for rule in schema.rules)
    return {code: above if above != "" else below
            for code, above, below in limits if above != below}  # fmt: skip


RULE = "new TelemetryRule("
JAVA_TIMES = ("pause_s", "max_pause_s", "quiet_s", "silent_s", "new_clock_s")


def java(schema: Schema) -> str:
    """Return the app's tables: fields, ages, events and alarms of telemetry."""

    def put(table: str, key: str, value: object) -> str:
        return f"        {table}.put({json.dumps(key)}, {value});\n"

    def grouped(table: str, values: list[tuple[str, Any]]) -> str:
        """Return a call for each value, with all of its keys."""
        keys: dict[Any, list[str]] = {}
        for key, value in values:
            keys.setdefault(value, []).append(key)
        return "".join(_java_call(f"put({table}, ", map(json.dumps, [value, *names]), ");")
                       for value, names in keys.items())  # fmt: skip

    def rule(columns: dict[str, Any]) -> list[str]:
        texts = [(k, ",".join(v) if k == "awaits" else str(v).lower() if v in (True, False) else v)
                 for k, v in _given(columns).items() if k != "finding"]  # fmt: skip
        return [f"{json.dumps(k)}, {json.dumps(str(v))}" for k, v in texts]

    shown = [each for each in schema.rules if each["event"] or each["alarm"]]
    fields = [each for each in schema.fields if each.in_telemetry]
    used = ("ArrayList", "Arrays", "Collections", "HashMap", "LinkedHashMap", "List", "Map")
    imports = "".join(f"import java.util.{each};\n" for each in used)
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
    /** Why a flight mode is not offered, or was replaced, by code. */
    static final Map<String, String> MODE_REASONS = new HashMap<>();
    private static final Map<String, String> NAVIGATION = new LinkedHashMap<>();
    private static final Map<String, Boolean> OPTIONAL = new HashMap<>();
    /** The board's modes in which a mode of the Raspberry Pi flies. */
    static final List<String> PI_MODES =
            Arrays.asList({", ".join(map(json.dumps, _pi_modes(schema)))});
    static final List<TelemetryRule> RULES = new ArrayList<>();
    /** Events without a field, by code. */
    static final Map<String, TelemetryRule> EVENTS = new HashMap<>();
    /** The outcomes of sent Commands. */
    static final Map<String, String> OUTCOMES = new HashMap<>();

    static {{
{"".join(put("STALE_MS", r.name, f"{round(1000 * r.stale_s)}L") for r in schema.readings)}\
{"".join(put("HOLDS_MS", k, f"{round(1000 * v)}L") for k, v in schema.holds_s.items())}\
{grouped("READING_OF", [(r.name, r.reading) for r in fields if r.reading])}\
{grouped("UNITS", [(r.name, r.unit) for r in fields if r.unit])}\
{grouped("DECIMALS", [(r.name, r.decimals) for r in fields if r.decimals != 3])}\
{"".join(put("LIMITS", k, float(v)) for k, v in _limits(schema).items())}\
{"".join(put("MODE_REASONS", k, json.dumps(v)) for k, v in schema.mode_reasons.items())}\
{"".join(put("NAVIGATION", r.label, json.dumps(r.name)) for r in schema.fields if r.label)}\
{"".join(put("OPTIONAL", r.name, "true") for r in schema.fields if r.optional)}\
{"".join(_java_call("RULES.add(" + RULE, rule(each), "));") for each in shown)}\
{
        "".join(
            _java_call(
                f"EVENTS.put({json.dumps(each.code)}, " + RULE, rule(event_rule(each)), "));"
            )
            for each in schema.events
        )
    }\
{"".join(put("OUTCOMES", r.code, json.dumps(r.text)) for r in schema.outcomes)}\
    }}

    /** Paths of the values of navigation, by label in the order of display. */
    public static Map<String, String> navigation() {{
        return Collections.unmodifiableMap(NAVIGATION);
    }}

    /** Whether a value of navigation is not shown while it is unknown. */
    public static boolean isOptional(String path) {{
        return OPTIONAL.containsKey(path);
    }}

    private TelemetrySchema() {{
    }}

    private static <T> void put(Map<String, T> table, T value, String... keys) {{
        for (String key : keys) {{
            table.put(key, value);
        }}
    }}
}}
"""


def _java_call(head: str, arguments: Iterable[str], end: str) -> str:
    """Return a call whose arguments fill lines of at most 100 characters."""
    lines = [" " * 8 + head]
    *others, last = arguments
    for piece in (*(f"{each}, " for each in others), last + end):
        if len((lines[-1] + piece).rstrip()) > 100:
            lines.append(" " * 16)
        lines[-1] += piece
    return "".join(f"{line.rstrip()}\n" for line in lines)
