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
    Item,
    Schema,
    SchemaError,
    event_rule,
)
from tools.schema_languages import cpp, java, javascript, python, python_telemetry  # noqa: E402


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
    text = _with_tables(text, tables)
    return re.sub(r"(?m)^(\| `x` \| 78 \| )\d+", rf"\g<1>{schema.size}", text)


def troubleshooting(schema: Schema, text: str) -> str:
    """Return docs/troubleshooting.md with the tables that the definitions determine."""
    rules = [*map(event_rule, schema.events), *schema.rules]
    # The source of each reading has the same code.
    shown = {(each["code"], each["cure"]): each for each in reversed(rules) if each["cure"]}
    tables: dict[str, list[Any]] = {
        "alarms": [("shown", "level", "code", "cause, cure"),
                   *((re.sub(r"\{.*?\}|^\w+(?= comes from)", "...", each["text"]), _level(each),
                      f"`{each['code']}`", each["cure"]) for each in reversed(shown.values()))],
        "vetoes": [("veto", "what to do"),
                   *((each.text, each.cure) for each in schema.bits["vetoes"] if each.cure)],
        "answers": [("code", "meaning"), *((f"`{r.code}`", r.text) for r in schema.answers)],
        "reasons": [("code", "reason"),
                    *((f"`{code}`", reason) for code, reason in schema.mode_reasons.items())],
    }  # fmt: skip
    return _with_tables(text, tables)


def _with_tables(text: str, tables: dict[str, list[Any]]) -> str:
    """Return a page with the rows of tables, each after its head, in their regions."""
    for name, (head, *rows) in tables.items():
        lines = [head, ("---",) * len(head), *filter(None, rows)]
        content = "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)
        text = _region(text, content, f"<!-- schema {name} begin -->", "<!-- schema end -->")
    return text


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
    return (condition + hidden if "path" in rule else "link", rule["alarm"] or "-", _level(rule),
            f"`{rule['code']}`", rule["text"], rule.get("end") or "-")  # fmt: skip


def _level(rule: dict[str, Any]) -> str:
    armed = rule.get("level_armed", rule["level"])
    return str(rule["level"]) + (f", {armed} while armed" if armed != rule["level"] else "")


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


def java_titles(text: str) -> str:
    """Return CommandTexts.java with the titles of the Commands."""
    puts = "".join(
        f"        TITLES.put({json.dumps(cls.NAME)}, {json.dumps(cls.TITLE)});\n"
        for cls in _commands().CATALOGUE
        if cls.TITLE
    )
    return _region(text, puts, "// schema begin", "// schema end")


def java_dictionary(text: str) -> str:
    """Return PackedDictionary.java with the dictionary of the first packed frame."""
    content = _module("up.protocols.packed_dictionary").DICTIONARY.decode("ascii")
    lines = [json.dumps(content[at : at + 64]) for at in range(0, len(content), 64)]
    joined = "\n            + ".join(lines)
    return _region(text, f"            {joined}\n", "// schema begin", "// schema end")


def _commands() -> Any:
    return _module("tools.command_tables")


def _module(name: str) -> Any:
    """Import a module, when the tables that it imports are written."""
    try:
        return importlib.import_module(name)
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
    "android/core/src/org/raspilot/up/ground/CommandTexts.java": lambda _, text: java_titles(text),
    "android/core/src/org/raspilot/up/wire/PackedDictionary.java": (
        lambda _, text: java_dictionary(text)
    ),
    "android/raspilot/assets/commands.json": lambda *_: _commands().forms(),
    "docs/protocols.md": documents,
    "docs/troubleshooting.md": troubleshooting,
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
