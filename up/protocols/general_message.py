"""The General Message: one JSON object per line (docs/protocols.md 4, thesis 3.1.4)."""

import json
import math
import re
from collections import Counter
from dataclasses import field
from typing import Any, NoReturn

from up.protocols.line_decoder import MAX_LINE_BYTES
from up.quick_dataclass import dataclass

MAX_NESTING = 32
MAX_NAME = 128
MAX_ID = 64
MAX_KEYS = 512
"""Keys of one object; it bounds the work per message."""

_MAX_WHOLE_NUMBER = 20
_NO_BRACKETS = re.compile(rb'"(?:[^"\\]++|\\.)*+(?:"|\\?\Z)|[^"\[\]{}]++', re.DOTALL)
_OPENING = b"[{"


@dataclass(frozen=True, slots=True)
class GeneralMessage:
    """One message: its Command, its fields, its id and its beacon."""

    name: str
    data: dict[str, Any] = field(default_factory=dict)
    id: str | None = None
    beacon: int | None = None


class MalformedMessage(ValueError):  # noqa: N818 - the protocol's term
    """A line that is not a General Message; `id` is set if it could be read."""

    def __init__(self, reason: str, id: str | None = None) -> None:
        super().__init__(reason)
        self.reason = reason
        self.id = id


def decode(line: bytes, longest: int = MAX_LINE_BYTES) -> GeneralMessage:
    """Return the message in `line`, with or without its line end; raises MalformedMessage."""
    fields, may_hold_surrogates = _decode(line, longest)
    return _message_of(fields, may_hold_surrogates=may_hold_surrogates)


def decode_object(line: bytes, longest: int) -> dict[str, Any]:
    """Return a JSON object of at most `longest` bytes, parsed as strictly as a General Message.

    Raises MalformedMessage.
    """
    fields, may_hold_surrogates = _decode(line, longest)
    if may_hold_surrogates and _has_lone_surrogate(fields):
        raise MalformedMessage("text with a lone surrogate")
    return fields


def _decode(line: bytes, longest: int) -> tuple[dict[str, Any], bool]:
    """Return the object, and whether its texts may hold surrogates."""
    if len(line) > longest:
        raise MalformedMessage(f"longer than {longest} bytes")
    try:
        text = line.decode("utf-8")
    except UnicodeDecodeError:
        raise MalformedMessage("not UTF-8") from None
    if line.count(b"[") + line.count(b"{") > MAX_NESTING and _is_too_deep(line):
        raise MalformedMessage(f"nested deeper than {MAX_NESTING}", _id_despite_fault(text))
    try:
        fields = _STRICT.decode(text)
    except json.JSONDecodeError as error:
        raise MalformedMessage(f"not JSON: {error.msg} at character {error.pos}") from None
    except ValueError as error:
        raise MalformedMessage(str(error), _id_despite_fault(text)) from None
    except RecursionError:
        raise MalformedMessage(f"nested deeper than {MAX_NESTING}") from None
    if not isinstance(fields, dict):
        raise MalformedMessage("not a JSON object")
    return fields, "\\ud" in text or "\\uD" in text


def encode(
    name: str,
    data: dict[str, Any],
    id: str | None = None,
    beacon: int | None = None,
    *,
    is_compact: bool = False,
) -> bytes:
    """Return one line with its LF, the keys in the order of the protocol; compact: no spaces.

    Raises ValueError, naming the key, for NaN, infinity and values that JSON cannot hold, and for a
    line of more than 16 KiB.
    """
    fields: dict[str, Any] = {"name": name, "data": data, "id": id}
    if beacon is not None:
        fields["beacon"] = beacon
    try:
        text = (_COMPACT if is_compact else _ENCODER).encode(fields)
    except (ValueError, TypeError) as error:
        fault = _find_fault(data, "data") or str(error)
        raise ValueError(f"{name}: {fault}") from None
    except RecursionError:
        raise ValueError(f"{name}: nested deeper than {MAX_NESTING}") from None
    if "\\ud" in text and _has_lone_surrogate(fields):
        raise ValueError(f"{name}: text with a lone surrogate")
    if len(text) >= MAX_LINE_BYTES:
        raise ValueError(f"{name}: a line of {len(text) + 1} bytes, at most {MAX_LINE_BYTES}")
    return text.encode("ascii") + b"\n"


def _message_of(fields: dict[str, Any], *, may_hold_surrogates: bool) -> GeneralMessage:
    id_ = _read_id(fields.get("id"))
    if may_hold_surrogates and _has_lone_surrogate(fields):
        raise MalformedMessage("text with a lone surrogate", _encodable(id_))
    name = fields.get("name")
    if not isinstance(name, str) or not 1 <= len(name) <= MAX_NAME:
        raise MalformedMessage(f"name is not a text of 1 to {MAX_NAME} characters", id_)
    data = fields.get("data")
    if data is None:
        data = {}
    elif not isinstance(data, dict):
        raise MalformedMessage("data is not an object", id_)
    beacon = fields.get("beacon")
    if beacon is not None and type(beacon) is not int:
        raise MalformedMessage("beacon is not a whole number", id_)
    return GeneralMessage(name, data, id_, beacon)


def _read_id(value: object) -> str | None:
    if value is None:
        return None
    if type(value) in (int, float):
        value = str(value)
    if not isinstance(value, str) or not 1 <= len(value) <= MAX_ID:
        raise MalformedMessage(f"id is not a text of 1 to {MAX_ID} characters")
    return value


def _encodable(id_: str | None) -> str | None:
    return None if id_ is None or _has_lone_surrogate(id_) else id_


def _id_despite_fault(text: str) -> str | None:
    """Return the id of a JSON object that violates a rule, so that it can be nacked."""
    try:
        fields = _LENIENT.decode(text)
        # With a repeated key the intended id is unknown; see _lenient_object.
        return _encodable(_read_id(fields.get("id"))) if isinstance(fields, dict) else None
    except (ValueError, RecursionError):
        return None


def _is_too_deep(line: bytes) -> bool:
    depth = 0
    for bracket in _NO_BRACKETS.sub(b"", line):
        depth += 1 if bracket in _OPENING else -1
        if depth > MAX_NESTING:
            return True
    return False


def _has_lone_surrogate(value: object) -> bool:
    try:
        json.dumps(value, ensure_ascii=False).encode("utf-8")
    except UnicodeEncodeError:
        return True
    return False


def _find_fault(value: object, path: str, depth: int = 2) -> str | None:
    """Return a sentence with the key path of a value that JSON cannot hold, or None."""
    if depth > MAX_NESTING:
        return f"{path} is nested deeper than {MAX_NESTING}"
    if isinstance(value, float):
        return None if math.isfinite(value) else f"{path} is {value}"
    if value is None or isinstance(value, str | int):
        return None
    if isinstance(value, dict):
        items = [(f"{path}.{key}", item) for key, item in value.items()]
    elif isinstance(value, list | tuple):
        items = [(f"{path}[{index}]", item) for index, item in enumerate(value)]
    else:
        return f"{path} is a {type(value).__name__}, which JSON cannot hold"
    faults = (_find_fault(item, item_path, depth + 1) for item_path, item in items)
    return next(filter(None, faults), None)


def _finite_float(text: str) -> float:
    number = float(text)
    if math.isinf(number):
        raise ValueError(f"the number {text[:20]} is too large")
    return number


def _bounded_int(text: str) -> int:
    if len(text) > _MAX_WHOLE_NUMBER:
        raise ValueError(f"a whole number of more than {_MAX_WHOLE_NUMBER} characters")
    return int(text)


def _refuse_constant(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a JSON number")


def _unique_object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(pairs) > MAX_KEYS:
        raise ValueError(f"an object with more than {MAX_KEYS} keys")
    fields = dict(pairs)
    if len(fields) != len(pairs):
        ((repeated, _),) = Counter(key for key, _ in pairs).most_common(1)
        raise ValueError(f"the key {repeated[:40]!r} is repeated")
    return fields


def _lenient_object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(pairs)
    if sum(key == "id" for key, _ in pairs) > 1:
        del fields["id"]
    return fields


_STRICT = json.JSONDecoder(
    parse_float=_finite_float,
    parse_int=_bounded_int,
    parse_constant=_refuse_constant,
    object_pairs_hook=_unique_object,
)
_LENIENT = json.JSONDecoder(
    parse_int=lambda text: int(text) if len(text) <= MAX_ID else None,
    object_pairs_hook=_lenient_object,
)
_ENCODER = json.JSONEncoder(allow_nan=False)
_COMPACT = json.JSONEncoder(allow_nan=False, separators=(",", ":"))
