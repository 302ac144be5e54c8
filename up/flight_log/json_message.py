"""The JSON of one logged message, read with suspicion: a log may come from anywhere."""

from __future__ import annotations

import json
import math
import re
from typing import Any, NoReturn

DEEPEST = 32
_TOO_LARGE = re.compile(r"\d[eE]\+?\d{3}|\d{300}")


def decode(data: bytes) -> dict[str, Any]:
    """Return the object; ValueError says what it is instead.

    Refused are NaN and infinity (numbers too large for a float too), nesting deeper than 32 and
    text with lone surrogates: whatever comes out can be written as JSON again.
    """
    try:
        text = str(data, "utf-8")
    except UnicodeDecodeError:
        raise ValueError("no UTF-8") from None
    is_strange = _TOO_LARGE.search(text) is not None
    try:
        fields = (_FINITE if is_strange else _PLAIN).decode(text)
    except (json.JSONDecodeError, RecursionError):
        raise ValueError("no JSON") from None
    if not isinstance(fields, dict):
        raise ValueError("no JSON object")
    if text.count("{") + text.count("[") > DEEPEST and _is_deep(fields, DEEPEST):
        raise ValueError(f"nested deeper than {DEEPEST}")
    if "\\ud" in text or "\\uD" in text:
        _refuse_surrogates(fields)
    return fields


def number_at(data: Any, path: tuple[str, ...]) -> float | None:
    """Return the finite number at a path of keys; None: there is none (true is no number)."""
    for key in path:
        if not isinstance(data, dict):
            return None
        data = data.get(key)
    if type(data) is float:
        return data
    if type(data) is not int:
        return None
    try:
        return float(data)
    except OverflowError:
        return None


def _is_deep(value: Any, left: int) -> bool:
    if isinstance(value, dict):
        return left == 0 or any(_is_deep(each, left - 1) for each in value.values())
    if isinstance(value, list):
        return left == 0 or any(_is_deep(each, left - 1) for each in value)
    return False


def _refuse_surrogates(fields: dict[str, Any]) -> None:
    try:
        json.dumps(fields, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        raise ValueError("text with a lone surrogate") from None


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError("a number that is too large")
    return number


def _refuse(text: str) -> NoReturn:
    raise ValueError(f"{text}, which is no JSON")


_PLAIN = json.JSONDecoder(parse_constant=_refuse)
_FINITE = json.JSONDecoder(parse_constant=_refuse, parse_float=_finite)
