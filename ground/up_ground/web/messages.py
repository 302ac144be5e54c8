"""Messages of the pages: bounds and types."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from up.protocols.general_message import MalformedMessage, decode_object

MAX_MESSAGE_BYTES = 65536
MAX_PLAN_BYTES = 1 << 20
"""Limit of a page that may control: a plan with all its items."""
_MAX_WHOLE = 2**53


class PageFault(ValueError):  # noqa: N818 - what the page did, the protocol's word
    """A message that cannot be accepted; the text is one sentence."""

    def __init__(self, text: str, code: str = "invalid") -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads typed fields of one message; every method raises PageFault."""

    fields: dict[str, Any]

    def text(self, key: str, longest: int = 200) -> str:
        found = self.optional_text(key, longest)
        if found is None:
            raise PageFault(f"{key} is missing")
        return found

    def optional_text(self, key: str, longest: int = 200) -> str | None:
        found = self.fields.get(key)
        if found is not None and (not isinstance(found, str) or len(found) > longest):
            raise PageFault(f"{key} is not a text of at most {longest} characters")
        return found

    def whole(self, key: str) -> int:
        """Return a whole number that JavaScript holds exactly."""
        found = self.optional_whole(key)
        if found is None:
            raise PageFault(f"{key} is missing")
        return found

    def optional_whole(self, key: str) -> int | None:
        found = self.fields.get(key)
        if found is None:
            return None
        if type(found) is float and found.is_integer():
            found = int(found)
        if type(found) is not int or not -_MAX_WHOLE < found < _MAX_WHOLE:
            raise PageFault(f"{key} is not a whole number")
        return found

    def number(self, key: str) -> float:
        found = self.fields.get(key)
        if isinstance(found, bool) or not isinstance(found, int | float):
            raise PageFault(f"{key} is not a number")
        return float(found)

    def object(self, key: str) -> dict[str, Any]:
        found = self.fields.get(key)
        if found is None:
            return {}
        if not isinstance(found, dict):
            raise PageFault(f"{key} is not an object")
        return found

    def list(self, key: str) -> list[Any]:
        found = self.fields.get(key, [])
        if not isinstance(found, list):
            raise PageFault(f"{key} is not a list")
        return found

    def choice(self, key: str, *words: str) -> str:
        found = self.text(key)
        if found not in words:
            raise PageFault(f"{key} is not one of {', '.join(words)}")
        return found


def read_message(payload: bytes) -> tuple[str, Reader]:
    """Return a message's type and its fields; raises PageFault."""
    try:
        fields = decode_object(payload, MAX_PLAN_BYTES)
    except MalformedMessage as error:
        raise PageFault(error.reason) from None
    reader = Reader(fields)
    return reader.text("type", 32), reader
