"""What the JSON Schema of a topic declares about its fields."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def unit_of(schema: Mapping[str, Any] | None, field: str) -> str:
    """Return the unit of a field, a path with dots; empty if the schema declares none."""
    about = about_field(schema, field)
    unit = about.get("x-unit") if about else None
    return unit if isinstance(unit, str) else ""


def about_field(schema: Mapping[str, Any] | None, field: str) -> Mapping[str, Any] | None:
    """Return the declaration of a field; None if the schema has none."""
    about: Any = schema
    for key in field.split("."):
        properties = about.get("properties") if isinstance(about, dict) else None
        about = properties.get(key) if isinstance(properties, dict) else None
    return about if isinstance(about, dict) else None
