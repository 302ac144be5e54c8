"""The JSON Schema of a Command, so that any program that reads the log knows its fields."""

import dataclasses
import typing
from collections.abc import Iterator
from typing import Any

from up.commands.command import BaseCommand, constraint_of
from up.commands.telemetry_commands import TelemetryCommand
from up.commands.telemetry_schema import PROPERTIES
from up.flight_log.origin_text import KEY

_ITEMS = {str: "string", int: "integer", float: "number", bool: "boolean"}
_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def schema_of(cls: type[BaseCommand]) -> dict[str, Any]:
    """Return the schema (draft 2020-12) of a Command's data on the wire, with their origin.

    A field's unit is in its description (and in ``x-unit``). A Command that builds its data itself
    (gains, a profile) is an object of any fields; telemetry has the tree of its page. Only the
    fields that the Command requires are required. A nullable field is marked as in OpenAPI 3
    (``nullable``): Foxglove refuses a list of types, an array without items and an object without
    properties.
    """
    properties: dict[str, Any] = {}
    required: list[str] = []
    if issubclass(cls, TelemetryCommand):
        properties.update(PROPERTIES)
    elif cls.data is BaseCommand.data:
        hints = typing.get_type_hints(cls)
        for field in dataclasses.fields(cls):
            key = field.metadata.get("key") or field.name
            schema = constraint_of(field, hints).json_schema()
            properties[key] = _property(schema, hints[field.name])
            if field.default is dataclasses.MISSING:
                required.append(key)
    properties[KEY] = {"type": "string", "description": "link and role of the sender"}
    return {
        "$schema": _DIALECT,
        "title": cls.NAME,
        "description": sentence_of(cls.__doc__),
        "type": "object",
        "properties": properties,
        "required": required,
    }


def _property(schema: dict[str, Any], hint: Any) -> dict[str, Any]:
    kind = schema["type"]
    if isinstance(kind, list):
        kind = kind[0]
        schema = {**schema, "type": kind, "nullable": True}
    if kind == "array":
        schema["items"] = {"type": _ITEMS.get(next(iter(_items_of(hint)), str), "string")}
    elif kind == "object":
        schema["properties"] = {}
    if "x-unit" in schema:
        schema["description"] = schema["x-unit"]
    return schema


def _items_of(hint: Any) -> Iterator[Any]:
    for each in (hint, *typing.get_args(hint)):
        if typing.get_origin(each) in (tuple, list):
            yield typing.get_args(each)[0]


def sentence_of(text: str | None) -> str:
    """Return the first paragraph of a docstring in one line."""
    return " ".join((text or "").split("\n\n")[0].replace("``", "").split())
