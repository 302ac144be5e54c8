"""The JSON Schema of a configuration file, so that editors complete and check it."""

from __future__ import annotations

from typing import Any

from up.config.schema import Entry, ListOf, MapOf, Schema, Spec
from up.config.values import plain_value
from up.fields import Constraint

_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def json_schema_of(filename: str, schema: Schema) -> dict[str, Any]:
    """Return the schema (draft 2020-12) of a file with this schema."""
    return {"$schema": _DRAFT, "title": filename, **_schema(schema)}


def _schema(spec: Spec) -> dict[str, Any]:
    if isinstance(spec, Constraint):
        return spec.json_schema()
    if isinstance(spec, ListOf):
        schema: dict[str, Any] = {"type": "array", "items": _schema(spec.item)}
        if spec.max_length is not None:
            schema["maxItems"] = spec.max_length
        return schema
    if isinstance(spec, MapOf):
        schema = {"type": "object", "additionalProperties": _schema(spec.value)}
        schema["propertyNames"] = spec.key.json_schema()
        if spec.max_length is not None:
            schema["maxProperties"] = spec.max_length
        return schema
    schema = {"type": "object", "additionalProperties": False}
    if spec.comment:
        schema["description"] = spec.comment
    schema["properties"] = {entry.name: _entry_schema(entry) for entry in spec.entries}
    return schema


def _entry_schema(entry: Entry) -> dict[str, Any]:
    schema = _schema(entry.spec)
    if entry.comment:
        schema["description"] = entry.comment
    if entry.default is not None or (isinstance(entry.spec, Constraint) and entry.spec.nullable):
        schema["default"] = plain_value(entry.spec, entry.default)
    return schema
