"""Fields of a Command as a person types them: ``mode=FBW pids.ratePIDs.ailerons.p=2``."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, NoReturn

from up.cli.cli_error import UsageError


def parse_fields(words: Iterable[str]) -> dict[str, Any]:
    """Return the data of a Command; a dot in a key opens an object.

    A value is taken as JSON where it is JSON (``2``, ``true``, ``null``, ``"2"``, ``{...}``) and
    as text otherwise. Raises UsageError.
    """
    data: dict[str, Any] = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not equals or not key:
            raise UsageError(f"{word!r} is not a field: write key=value", "invalid_field")
        _put(data, key, _value(text))
    return data


def _value(text: str) -> Any:
    try:
        return json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError):
        return text


def _refuse(text: str) -> NoReturn:
    raise ValueError(text)


def _put(data: dict[str, Any], key: str, value: Any) -> None:
    *path, last = key.split(".")
    place = data
    for name in path:
        inner = place.setdefault(name, {})
        if not isinstance(inner, dict):
            raise UsageError(
                f"{key}: {name} already has a value and can hold no fields", "invalid_field"
            )
        place = inner
    if not last or not all(path):
        raise UsageError(f"{key!r} is not a key: a part between its dots is empty", "invalid_field")
    if last in place:
        raise UsageError(f"{key} is given twice", "invalid_field")
    place[last] = value
