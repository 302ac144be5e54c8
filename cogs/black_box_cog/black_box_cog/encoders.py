"""Fast JSON encoding of Commands: a flight produces hundreds per second.

A Command with numeric fields is written through a template for the types of its values: a third of
a JSON encoder's time. Numbers have twelve significant digits.
"""

import json
from collections.abc import Callable, Sequence
from math import isfinite
from operator import attrgetter
from types import NoneType
from typing import Any

from up.commands.command import BaseCommand, wire_fields
from up.commands.origin import Origin
from up.commands.telemetry_commands import TelemetryCommand
from up.flight_log.origin_text import KEY, origin_text

Encode = Callable[[Any], str]
"""Returns the JSON object of a Command."""

_PLACES: dict[type, str] = {float: "%.12g", int: "%d", NoneType: "null%.0s"}
_ORIGINS_LIMIT = 256
_ENCODER = json.JSONEncoder(
    separators=(",", ":"), allow_nan=False, check_circular=False, default=str
)


def json_of(content: Any) -> str:
    """Return the JSON of dicts, lists and values; numbers that are not finite become null."""
    try:
        return _ENCODER.encode(content)
    except ValueError:
        return _ENCODER.encode(_finite(content))


def encoder_of(cls: type[BaseCommand]) -> Encode:
    """Return the function that turns Commands of a class into JSON objects."""
    if issubclass(cls, TelemetryCommand):
        return lambda command: json_of({**command.content, "_beacon": command.beacon})
    fields = wire_fields(cls)
    if cls.data is not BaseCommand.data or not fields:
        return lambda command: json_of(command.data)
    return _by_template([name for name, _, _ in fields], [key for _, key, _ in fields])


class OriginTexts:
    """The origin as the end of a JSON object, cached because there are few."""

    def __init__(self) -> None:
        self._texts: dict[int, tuple[Origin, str]] = {}

    def ended(self, text: str, origin: Origin) -> bytes:
        known = self._texts.get(id(origin))
        if known is None:
            if len(self._texts) >= _ORIGINS_LIMIT:
                self._texts.clear()
            known = origin, f"{json.dumps(KEY)}:{json.dumps(origin_text(origin))}}}"
            # The origin stays referenced, so that no other object can get its id.
            self._texts[id(origin)] = known
        if text == "{}":
            return f"{{{known[1]}".encode("ascii")
        return f"{text[:-1]},{known[1]}".encode("ascii")


def _by_template(names: Sequence[str], keys: Sequence[str]) -> Encode:
    take: Callable[[Any], tuple[Any, ...]]
    get = attrgetter(*names)
    take = get if len(names) > 1 else lambda command: (get(command),)
    heads = [json.dumps(key).replace("%", "%%") + ":" for key in keys]
    templates: dict[tuple[type, ...], str] = {}

    def encode(command: BaseCommand) -> str:
        values = take(command)
        types = tuple(map(type, values))
        template = templates.get(types)
        if template is None:
            template = templates[types] = _template(heads, types)
        if template and isfinite(sum(filter(None, values))):
            return template % values
        return json_of(dict(zip(keys, values, strict=True)))

    return encode


def _template(heads: Sequence[str], types: Sequence[type]) -> str:
    """Return the template for values of these types; empty without one."""
    if not all(each in _PLACES for each in types):
        return ""
    places = (head + _PLACES[each] for head, each in zip(heads, types, strict=True))
    return f"{{{','.join(places)}}}"


def _finite(content: Any) -> Any:
    if isinstance(content, float):
        return content if isfinite(content) else None
    if isinstance(content, dict):
        return {key: _finite(each) for key, each in content.items()}
    if isinstance(content, list | tuple):
        return [_finite(each) for each in content]
    return content
