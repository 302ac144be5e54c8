"""Tables of the Commands of Up and of every installed cog, for tools/schema.py."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from pathlib import Path
from typing import get_type_hints

from up.commands.command import constraint_of
from up.flight_log.command_schema import schema_of
from up_ground.catalogue import Catalogue, about, catalogue_message, roles_text, wire_name

CATALOGUE = Catalogue.installed()


def rows() -> Iterator[tuple[str, ...]]:
    """Yield the rows of the documents' table: name, who may send it, fields, purpose."""
    for cls in CATALOGUE:
        hints = get_type_hints(cls)
        fields = (
            f"`{wire_name(each)}`{'?' * (each.default is not dataclasses.MISSING)}"
            f" {constraint_of(each, hints).describe()}"
            for each in dataclasses.fields(cls)
        )
        names = ", alias ".join(f"`{name}`" for name in (cls.NAME, *cls.ALIASES))
        beacon = ", with a beacon" if cls.NEEDS_BEACON else ""
        yield names, roles_text(cls) + beacon, "; ".join(fields), about(cls)


def forms(catalogue: Catalogue = CATALOGUE) -> str:
    """Return the forms that the app shows; raises ValueError if a Command would be missing."""
    if catalogue.problems:
        raise ValueError(catalogue.problems[0])
    message = catalogue_message(catalogue)
    missing = len(catalogue.sendable()) - len(message["commands"])
    if missing:
        raise ValueError(f"the catalogue has become too long, it lacks {missing} Commands")
    return json.dumps(message, indent=1) + "\n"


def write_json_schemas(folder: Path) -> None:
    """Write the JSON Schema of each Command's data; ``up.telemetry.update`` has telemetry's."""
    folder.mkdir(parents=True, exist_ok=True)
    for cls in CATALOGUE:
        text = json.dumps(schema_of(cls), indent=2) + "\n"
        (folder / f"{cls.NAME}.json").write_text(text, encoding="utf-8")
