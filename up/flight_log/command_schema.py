"""The JSON Schema of a Command, so that any program that reads the log knows its fields."""

from __future__ import annotations

import dataclasses
import typing
from typing import Any

from up.commands.command import BaseCommand, constraint_of
from up.flight_log.origin_text import KEY

_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def schema_of(cls: type[BaseCommand]) -> dict[str, Any]:
    """Return the schema (draft 2020-12) of a Command's data on the wire, with their origin.

    A field's unit stands in its description (and in ``x-unit``). A Command that makes its data
    itself (telemetry, gains) is an object of any fields. Nothing is required but what the Command
    itself requires.
    """
    properties: dict[str, Any] = {}
    required: list[str] = []
    if cls.data is BaseCommand.data:
        hints = typing.get_type_hints(cls)
        for field in dataclasses.fields(cls):
            key = field.metadata.get("key") or field.name
            properties[key] = _property(constraint_of(field, hints).json_schema())
            if field.default is dataclasses.MISSING:
                required.append(key)
    properties[KEY] = {"type": "string", "description": "the link and role that it came from"}
    return {
        "$schema": _DIALECT,
        "title": cls.NAME,
        "description": _sentence(cls.__doc__),
        "type": "object",
        "properties": properties,
        "required": required,
    }


def _property(schema: dict[str, Any]) -> dict[str, Any]:
    unit = schema.get("x-unit")
    return {**schema, "description": unit} if unit else schema


def _sentence(text: str | None) -> str:
    return " ".join((text or "").split("\n\n")[0].replace("``", "").split())
