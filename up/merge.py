"""Deep merging of what modules contribute to telemetry (thesis 4.1.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

Conflict = Callable[[str, str, str], object]
_PLAIN = (str, int, bool, type(None))


def merge(
    contents: Iterable[tuple[str, Mapping[str, Any]]], on_conflict: Conflict
) -> dict[str, Any]:
    """Merge (module name, content) pairs; maps are merged, everything else is a value.

    Two different values under one key are a conflict: ``on_conflict(key path, first module, later
    module)`` is told, the earlier value stays and only the later module's key is dropped. Numbers
    that are not finite become null, and values that JSON does not have are dropped as conflicts
    of the module with itself.
    """
    merged: dict[str, Any] = {}
    owners: dict[tuple[str, ...], str] = {}
    for module, content in contents:
        _merge_into(merged, content, module, (), owners, on_conflict)
    return merged


def _merge_into(
    target: dict[str, Any],
    content: Mapping[str, Any],
    module: str,
    path: tuple[str, ...],
    owners: dict[tuple[str, ...], str],
    on_conflict: Conflict,
) -> None:
    for raw_key, raw in content.items():
        key = raw_key if isinstance(raw_key, str) else str(raw_key)
        here = (*path, key)
        if isinstance(raw, Mapping):
            below = target.get(key)
            if key in target and not isinstance(below, dict):
                on_conflict(".".join(here), owners.get(here, "?"), module)
                continue
            if below is None:
                below = target[key] = {}
                owners.setdefault(here, module)
            _merge_into(below, raw, module, here, owners, on_conflict)
            continue
        try:
            value = _json_value(raw)
        except TypeError:
            on_conflict(".".join(here), module, module)
            continue
        if key in target and (target[key] != value or isinstance(target[key], dict)):
            on_conflict(".".join(here), owners.get(here, "?"), module)
            continue
        target[key] = value
        owners.setdefault(here, module)


def _json_value(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, _PLAIN):
        return value
    if isinstance(value, list | tuple):
        return [_json_value(each) for each in value]
    if isinstance(value, Mapping):
        return {str(key): _json_value(each) for key, each in value.items()}
    raise TypeError(f"no JSON for {value!r}")
