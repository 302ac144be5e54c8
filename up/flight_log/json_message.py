"""Parses the JSON of one logged message strictly: a log may come from anywhere."""

import json
import math
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn

MAX_DEPTH = 32
_INFINITY = math.inf
_TOO_LARGE = "a number that is too large"
_DIGITS_AS_0 = bytes.maketrans(b"123456789E", b"000000000e")
_LONG = b"0" * 300


def decode(data: bytes) -> dict[str, Any]:
    """Return the object; ValueError names the fault of the text.

    Refuses NaN and infinity (also numbers too large for a float), nesting deeper than 32 and text
    with lone surrogates: every result can be written as JSON again.
    """
    try:
        text = str(data, "utf-8")
    except UnicodeDecodeError:
        raise ValueError("not UTF-8") from None
    try:
        fields = _DECODER.decode(text)
    except (json.JSONDecodeError, RecursionError):
        raise ValueError("not JSON") from None
    if not isinstance(fields, dict):
        raise ValueError("not a JSON object")
    if text.count("{") + text.count("[") > MAX_DEPTH:
        _reject_deep(fields)
    if _may_be_too_large(data):
        _reject_too_large(fields)
    if "\\u" in text:
        _reject_surrogates(fields)
    return fields


def decode_all(messages: Sequence[bytes]) -> list[dict[str, Any] | ValueError]:
    """Return the object of each message as `decode` does, or the error that it raises.

    Several times as fast for short messages: they are parsed together, and one by one only if any
    of them may be refused.
    """
    joined = b",".join(messages)
    # One bracket a message, so that none of them completes another.
    is_flat = joined.count(b"{") == len(messages) and b"[" not in joined
    if is_flat and b"\\u" not in joined:
        try:
            found = _DECODER.decode(f"[{str(joined, 'utf-8')}]")
        except (ValueError, RecursionError):
            found = []
        is_all_there = len(found) == len(messages) and {*map(type, found)} == {dict}
        if is_all_there and not _may_be_too_large(joined):
            return found  # type: ignore[no-any-return]
    return [_decoded(each) for each in messages]


def _decoded(message: bytes) -> dict[str, Any] | ValueError:
    try:
        return decode(message)
    except ValueError as error:
        return error


def value_at(data: Any, path: Iterable[str]) -> Any:
    """Return the value at a path of keys, or None."""
    for key in path:
        if not isinstance(data, dict):
            return None
        data = data.get(key)
    return data


def number_at(data: Any, path: Iterable[str]) -> float | None:
    """Return the finite number at a path of keys, or None (true is not a number)."""
    # Not by value_at: a report reads millions of numbers.
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


def _may_be_too_large(data: bytes) -> bool:
    """Return whether the text may contain a number beyond a float's range."""
    # Ten times as fast as a regular expression.
    numbers = data.translate(_DIGITS_AS_0)
    return b"0e0" in numbers or b"0e+0" in numbers or _LONG in numbers


def _reject_too_large(value: Any) -> None:
    items = value.values() if isinstance(value, dict) else value
    if _INFINITY in items or -_INFINITY in items:
        raise ValueError(_TOO_LARGE)
    for each in items:
        if type(each) in (dict, list):
            _reject_too_large(each)


def _reject_deep(fields: dict[str, Any]) -> None:
    level: list[Any] = [fields]
    for _ in range(MAX_DEPTH):
        level = [
            each
            for group in level
            for each in (group.values() if type(group) is dict else group)
            if type(each) is dict or type(each) is list
        ]
        if not level:
            return
    raise ValueError(f"nested deeper than {MAX_DEPTH}")


def _reject_surrogates(fields: dict[str, Any]) -> None:
    try:
        json.dumps(fields, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        raise ValueError("text with a lone surrogate") from None


def _reject(text: str) -> NoReturn:
    raise ValueError(f"{text}, which is not JSON")


_DECODER = json.JSONDecoder(parse_constant=_reject)
