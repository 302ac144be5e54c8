"""A phone's request to the runner: parses one JSON line (docs/protocols.md, section 8)."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import field, replace
from typing import Any, Literal, NoReturn

from up.protocols.runner_session import PROTECTED, body_of
from up.quick_dataclass import dataclass
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE

MAX_LINE = 64 * 1024
"""Maximum length of a request in bytes, without its line feed."""
DEFAULT_NAME = "default"
"""The instance that all nameless clients share."""
NAME = AIRCRAFT_NAME
LABEL = re.compile(r"[A-Za-z0-9_.-]{1,32}", re.ASCII)
MAX_LABELS = 16
_MAX_TEXT = 256
_MAX_WORD = 64
_MAX_SHOWN = 100

Scalar = bool | int | float | str
Configuration = Mapping[str, Mapping[str, Scalar]]


class MalformedRequest(ValueError):  # noqa: N818 - it names the input, not a fault of ours
    """A line that is not a request; the text is the sentence for the answer."""


@dataclass(frozen=True, slots=True)
class Request:
    """A request: the aircraft, the profile and settings, and whether to start or only to query.

    `labels` must all be among those of the host. `body` is that of a protected line, which is
    nothing else; `key` the id of the key that signed the request.
    """

    aircraft: str = DEFAULT_NAME
    profile: str | None = None
    configuration: Configuration = field(default_factory=dict)
    action: Literal["spawn", "status"] = "spawn"
    labels: tuple[str, ...] = ()
    body: bytes = b""
    key: str = ""

    @property
    def wants_configuration(self) -> bool:
        return self.profile is not None or bool(self.configuration)

    def same_configuration(self, other: Request) -> bool:
        return self.profile == other.profile and self.configuration == other.configuration

    def as_json(self) -> dict[str, Any]:
        """Return the fields that `parse` reads; the key is not among them."""
        return {
            "aircraft": self.aircraft,
            "profile": self.profile,
            "configuration": {file: dict(keys) for file, keys in self.configuration.items()},
            "action": self.action,
            "labels": list(self.labels),
        }


def parse(line: bytes) -> Request:
    """Return the request in a line, with or without its line end.

    Unknown keys are ignored. Raises MalformedRequest with one sentence for anything other than a
    request of at most MAX_LINE bytes.
    """
    line = line.strip(b" \t\r\n")
    if len(line) > MAX_LINE:
        raise MalformedRequest(f"the request is longer than {MAX_LINE} bytes")
    found = _decode(line)
    if not isinstance(found, dict):
        raise MalformedRequest("the request is not a JSON object")
    action = found.get("action")
    if action == PROTECTED:
        try:
            return Request(body=body_of(found))
        except ValueError:
            raise MalformedRequest("body must be a text of hexadecimal digits") from None
    if action not in (None, "spawn", "status"):
        raise MalformedRequest("action must be spawn, status or protected")
    return Request(
        aircraft=_name(found, "aircraft") or DEFAULT_NAME,
        profile=_name(found, "profile"),
        configuration=_configuration(found.get("configuration")),
        action="status" if action == "status" else "spawn",
        labels=_labels(found.get("labels")),
    )


def encode_request(request: Request) -> dict[str, Any]:
    """Return the fields of a request, with the id of the key that signed it."""
    return {"request": request.as_json(), "key": request.key}


def decode_request(fields: Mapping[str, Any]) -> Request:
    """Raises MalformedRequest."""
    if not isinstance(fields.get("request"), dict):
        raise MalformedRequest("the request is missing")
    request = parse(json.dumps(fields["request"]).encode())
    return replace(request, key=str(fields.get("key", "")))


def _decode(line: bytes) -> Any:
    try:
        return json.loads(
            line.decode("utf-8"), object_pairs_hook=_unique, parse_constant=_refuse_constant
        )
    except UnicodeDecodeError:
        raise MalformedRequest("the request is not UTF-8 text") from None
    except RecursionError:
        raise MalformedRequest("the request is nested too deep") from None
    except MalformedRequest:
        raise
    except ValueError:
        raise MalformedRequest("the request is not valid JSON") from None


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise MalformedRequest("the request names a key twice")
    return found


def _refuse_constant(text: str) -> NoReturn:
    raise MalformedRequest("the request holds a number that is not finite")


def _name(found: Mapping[str, Any], key: str) -> str | None:
    value = found.get(key)
    if value is None:
        return None
    if not isinstance(value, str) or not NAME.fullmatch(value):
        raise MalformedRequest(f"{key} must be {AIRCRAFT_NAME_RULE}")
    return value


def _labels(value: Any) -> tuple[str, ...]:
    if value is None:
        return ()
    are_words = isinstance(value, list) and all(
        isinstance(each, str) and LABEL.fullmatch(each) for each in value
    )
    if not are_words or len(value) > MAX_LABELS:
        raise MalformedRequest(f"labels must be at most {MAX_LABELS} words of A-Z a-z 0-9 _ . -")
    return tuple(value)


def _configuration(value: Any) -> dict[str, dict[str, Scalar]]:
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise MalformedRequest("configuration must be an object of files")
    for file, settings in value.items():
        _check_word(file)
        if not isinstance(settings, dict):
            raise MalformedRequest(f"configuration of {_shown(file)} must be an object of keys")
        for key, setting in settings.items():
            _check_word(key)
            _check_setting(f"{_shown(file)} {_shown(key)}", setting)
    return value


def _check_setting(where: str, value: Any) -> None:
    if isinstance(value, str):
        if len(value) > _MAX_TEXT or not value.isprintable() or "/" in value or "\\" in value:
            raise MalformedRequest(
                f"{where} must be at most {_MAX_TEXT} printable characters without slashes"
            )
    elif isinstance(value, float):
        if not math.isfinite(value):
            raise MalformedRequest(f"{where} must be a finite number")
    elif isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise MalformedRequest(f"{where} must be a number of at most 64 bits")
    else:
        raise MalformedRequest(f"{where} must be a number, a text, true or false")


def _check_word(text: str) -> None:
    if not text or len(text) > _MAX_WORD:
        raise MalformedRequest(f"a file or key must have 1 to {_MAX_WORD} characters")


def _shown(text: str) -> str:
    """Return the text in ASCII and quoted, cut where its escapes would make the sentence long."""
    shown = ascii(text)
    return shown if len(shown) <= _MAX_SHOWN else f"{shown[:_MAX_SHOWN]}..."
