"""Deep merging of the modules' telemetry content (thesis 4.1.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

Conflict = Callable[[str, str, str], object]
MAX_DEPTH = 16
MAX_LENGTH = 1000
_INT_LIMIT = 2**63
_PLAIN = frozenset((bool, int, float, str, type(None)))
"""Types that are never a map: skips the slow isinstance check."""


def merge(
    contents: Iterable[tuple[str, Mapping[str, Any]]], on_conflict: Conflict
) -> dict[str, Any]:
    """Merge (module name, content) pairs; maps are merged, everything else is a value.

    Two different values under one key are a conflict: calls ``on_conflict(key path, first module,
    later module)``, keeps the earlier value and drops only the later module's key. Numbers that are
    not finite become null. Values that JSON or a General Message cannot hold (other types, nesting
    beyond ``MAX_DEPTH``, text or lists beyond ``MAX_LENGTH``, integers of more than 64 bits, lone
    surrogates) are dropped as a conflict of the module with itself, and so is the rest of a map
    that raises while being read.
    """
    merged: dict[str, Any] = {}
    owners: dict[tuple[str, ...], str] = {}
    for module, content in contents:
        try:
            _merge_into(merged, content, module, (), owners, on_conflict)
        except Exception:  # noqa: BLE001 - a module's map must not cost the others' contents
            on_conflict("*", module, module)
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
        if len(here) > MAX_DEPTH or not _is_sound(key):
            on_conflict(".".join(path), module, module)
            continue
        if type(raw) not in _PLAIN and isinstance(raw, Mapping):
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


def _json_value(value: Any, depth: int = 0) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, int) and -_INT_LIMIT <= value < _INT_LIMIT:
        return value
    if isinstance(value, str) and _is_sound(value):
        return value
    if isinstance(value, list | tuple) and len(value) <= MAX_LENGTH and depth < MAX_DEPTH:
        return [_json_value(each, depth + 1) for each in value]
    if isinstance(value, Mapping) and depth < MAX_DEPTH:
        return {str(key): _json_value(each, depth + 1) for key, each in value.items()}
    raise TypeError("no JSON, or too much of it")


def _is_sound(text: str) -> bool:
    if len(text) > MAX_LENGTH:
        return False
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
