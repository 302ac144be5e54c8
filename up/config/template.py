"""Writes a commented configuration file from a schema and its values."""

import math
import re
import textwrap
from collections.abc import Iterator
from typing import Any

from up.config.scalars import needs_quotes
from up.config.schema import Entry, ListOf, MapOf, Schema, Spec, plain_value
from up.fields import Constraint, number_text

_WIDTH = 78
_PLAIN = re.compile(r"[A-Za-z_/]([\w ./()+-]*[\w/)+-])?", re.ASCII)
_INDENT = "  "


def template_of(schema: Schema, values: Any) -> str:
    """Return the file: the head comment, then every key with its comment."""
    lines = [*_comment(schema.comment, "")]
    if not schema.entries:
        lines.append("{}")
    for entry in schema.entries:
        lines.extend(["", *_entry(entry, getattr(values, entry.attribute), "")])
    return "\n".join(lines).lstrip("\n") + "\n"


def yaml_scalar(value: object) -> str:
    """Return one scalar as YAML that every reader parses to the same value."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _float_text(value)
    if isinstance(value, int):
        return str(value)
    text = str(value)
    return text if _PLAIN.fullmatch(text) and not needs_quotes(text) else _quoted(text)


def _entry(entry: Entry, value: Any, indent: str) -> Iterator[str]:
    yield from _comment(entry.comment, indent)
    yield from _comment(_allowed(entry), indent)
    name = yaml_scalar(entry.name)
    if isinstance(entry.spec, Schema):
        yield from _section(name, entry.spec, value, indent)
        return
    if isinstance(entry.spec, MapOf | ListOf):
        yield from _example(entry.spec, indent)
    yield from _pair(name, plain_value(entry.spec, value), indent)


def _section(name: str, schema: Schema, value: Any, indent: str) -> Iterator[str]:
    if value is None or not schema.entries:
        # An absent optional section appears as a comment, ready to be uncommented.
        mark = "# " if value is None else ""
        for line in _pair(name, plain_value(schema, schema.defaults()), ""):
            yield f"{indent}{mark}{line}"
        return
    yield f"{indent}{name}:"
    inner = indent + _INDENT
    for number, entry in enumerate(schema.entries):
        if number:
            yield ""
        yield from _entry(entry, getattr(value, entry.attribute), inner)


def _pair(name: str, value: Any, indent: str) -> Iterator[str]:
    if isinstance(value, dict) and value:
        yield f"{indent}{name}:"
        for key, inner in value.items():
            yield from _pair(yaml_scalar(key), inner, indent + _INDENT)
    elif isinstance(value, list) and value:
        yield f"{indent}{name}:"
        for item in value:
            yield f"{indent}{_INDENT}- {_flow(item)}"
    else:
        yield f"{indent}{name}: {_flow(value)}"


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        pairs = (f"{yaml_scalar(key)}: {_flow(inner)}" for key, inner in value.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(item) for item in value) + "]"
    return yaml_scalar(value)


def _example(spec: MapOf | ListOf, indent: str) -> Iterator[str]:
    """Yield an example entry of a free map or a list of maps, as a comment."""
    inner = spec.value if isinstance(spec, MapOf) else spec.item
    if isinstance(inner, Schema):
        example = _flow(plain_value(inner, inner.defaults()))
        head = "name: " if isinstance(spec, MapOf) else "- "
        yield f"{indent}# For example  {head}{example}"


def _comment(text: str, indent: str) -> Iterator[str]:
    for paragraph in text.split("\n\n"):
        for line in textwrap.wrap(
            " ".join(paragraph.split()),
            _WIDTH - len(indent) - 2,
            break_long_words=False,
            break_on_hyphens=False,
        ):
            yield f"{indent}# {line}"


def _allowed(entry: Entry) -> str:
    """Return the sentence with unit, range or choices, and default of a key."""
    parts = [*_bounds(entry.spec)]
    if isinstance(entry.spec, Constraint):
        default = yaml_scalar(entry.default)
        parts.append(f"Default: {default}.")
    return " ".join(parts)


def _bounds(spec: Spec) -> Iterator[str]:
    if isinstance(spec, Schema):
        return
    if not isinstance(spec, Constraint):
        if spec.max_length is not None:
            yield f"At most {spec.max_length} entries."
        return
    if spec.unit:
        yield f"Unit: {spec.unit}."
    if spec.choices is not None:
        yield "One of: " + ", ".join(yaml_scalar(choice) for choice in spec.choices) + "."
    if spec.minimum is not None and spec.maximum is not None:
        yield f"Range: {number_text(spec.minimum)} to {number_text(spec.maximum)}."
    elif spec.minimum is not None:
        yield f"At least {number_text(spec.minimum)}."
    elif spec.maximum is not None:
        yield f"At most {number_text(spec.maximum)}."
    if spec.max_length is not None:
        yield f"At most {spec.max_length} characters."
    if spec.nullable:
        yield "May be null."


def _float_text(value: float) -> str:
    if not math.isfinite(value):
        raise ValueError(f"{value!r} is not a finite number")
    text = repr(value)
    # YAML 1.1 reads an exponent without a decimal point as text.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _quoted(text: str) -> str:
    escaped = []
    for character in text:
        if character in '"\\':
            escaped.append("\\" + character)
        elif character.isprintable():
            escaped.append(character)
        else:
            code = ord(character)
            escaped.append(f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}")
    return '"' + "".join(escaped) + '"'
