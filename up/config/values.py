"""Values of configuration dataclasses as plain maps, lists and scalars."""

from __future__ import annotations

from typing import Any

from up.config.schema import ListOf, MapOf, Schema, Spec


def plain_value(spec: Spec, value: Any) -> Any:
    """Return a value as JSON and YAML types, with the file's key names; None stays None."""
    if value is None:
        return None
    if isinstance(spec, Schema):
        return {
            entry.name: plain_value(entry.spec, getattr(value, entry.attribute))
            for entry in spec.entries
        }
    if isinstance(spec, MapOf):
        return {name: plain_value(spec.value, inner) for name, inner in value.items()}
    if isinstance(spec, ListOf):
        return [plain_value(spec.item, inner) for inner in value]
    return value
