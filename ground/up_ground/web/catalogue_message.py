"""The Commands as pages receive them: enough to offer a form for each."""

from __future__ import annotations

import dataclasses
import json
import typing
from typing import Any

from up.commands.command import BaseCommand, constraint_of
from up_ground.catalogue import Catalogue, about, role_of, wire_name

BYTES_LIMIT = 1 << 18
"""A page for which more waits is cut off; this must never do that."""
LONGEST_TEXT = 400
_TYPES = {
    bool: "boolean",
    int: "integer",
    float: "number",
    str: "text",
    dict: "object",
    list: "list",
}


def catalogue_message(catalogue: Catalogue) -> dict[str, Any]:
    """Return the message ``catalogue``: every Command that some ground may send, by name."""
    commands: list[dict[str, Any]] = []
    size = 0
    for cls in catalogue.sendable():
        told = _command(cls)
        size += len(json.dumps(told))
        if size > BYTES_LIMIT:
            break
        commands.append(told)
    return {"type": "catalogue", "commands": commands}


def _command(cls: type[BaseCommand]) -> dict[str, Any]:
    hints = typing.get_type_hints(cls)
    return {
        "name": cls.NAME,
        "aliases": list(cls.ALIASES),
        # "depends": a field decides who may send it, checked by the aircraft and the server.
        "role": role_of(cls),
        "text": about(cls)[:LONGEST_TEXT],
        "needs_beacon": cls.NEEDS_BEACON,
        "fields": [_field(each, hints) for each in dataclasses.fields(cls)],
    }


def _field(field: dataclasses.Field[Any], hints: dict[str, Any]) -> dict[str, Any]:
    constraint = constraint_of(field, hints)
    missing = dataclasses.MISSING
    choices = constraint.choices
    return {
        "name": wire_name(field),
        "type": _TYPES[constraint.type_],
        "unit": constraint.unit,
        "minimum": constraint.minimum,
        "maximum": constraint.maximum,
        "choices": None if choices is None else list(choices),
        "max_length": constraint.max_length,
        "nullable": constraint.nullable,
        "required": field.default is missing and field.default_factory is missing,
        "text": constraint.describe()[:LONGEST_TEXT],
    }
