"""The cells of a table."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from up.fields import printable

_FORMULA = ("=", "+", "-", "@")


def flat(data: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the values of a message by dotted paths; an empty inner map yields nothing."""
    for key, value in data.items():
        path = f"{prefix}{key}"
        if isinstance(value, Mapping):
            yield from flat(value, f"{path}.")
        else:
            yield path, value


def cell(value: Any) -> str:
    """Return a value as a cell: numbers in full precision, empty for null and not-a-number.

    Text becomes one line; one that a spreadsheet would read as a formula gets an apostrophe first.
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else ""
    if not isinstance(value, str):
        value = json.dumps(value, ensure_ascii=False)
    text = printable(value)
    return f"'{text}" if text.startswith(_FORMULA) else text
