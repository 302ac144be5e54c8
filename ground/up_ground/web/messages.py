"""Messages between the server and the pages: encoding, validation."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from up.protocols.general_message import MalformedMessage, decode_object

_ENCODER = json.JSONEncoder(allow_nan=False, separators=(",", ":"))
_FINAL_TEXT = 0x81


def text_frame(payload: bytes) -> bytes:
    """Return the one frame of a text message, unmasked as a server's are; ``payload`` is UTF-8.

    Made here so that one message is encoded once for all pages, and so that unsent messages can
    still be replaced.
    """
    size = len(payload)
    if size < 126:
        return bytes((_FINAL_TEXT, size)) + payload
    if size < 65536:
        return struct.pack(">BBH", _FINAL_TEXT, 126, size) + payload
    return struct.pack(">BBQ", _FINAL_TEXT, 127, size) + payload


def message_bytes(fields: Mapping[str, Any]) -> bytes:
    """Return a message as one text frame."""
    return text_frame(_ENCODER.encode(fields).encode("ascii"))


class FrameMessage:
    """A frame of telemetry: encoded to JSON once for all pages, at the time of sending.

    ``age_s`` returns its age at a time ``now_s`` of the monotonic clock. ``time_s``: its time in
    a recorded flight.
    """

    __slots__ = ("_age_s", "_body", "_now_s")

    def __init__(
        self,
        aircraft: str,
        beacon: int | None,
        data: Mapping[str, Any],
        age_s: Callable[[float], float],
        now_s: Callable[[], float],
        time_s: float | None = None,
    ) -> None:
        fields: dict[str, Any] = {
            "type": "frame",
            "aircraft": aircraft,
            "beacon": beacon,
            "data": data,
        }
        if time_s is not None:
            fields["time_s"] = round(time_s, 3)
        self._body = _ENCODER.encode(fields)[:-1].encode("ascii") + b',"age_ms":'
        self._age_s = age_s
        self._now_s = now_s

    def __call__(self) -> bytes:
        now_s = self._now_s()
        age_ms, sent_ms = self._age_s(now_s) * 1000, now_s * 1000
        return text_frame(b'%b%.1f,"sent_ms":%.1f}' % (self._body, age_ms, sent_ms))


MAX_MESSAGE_BYTES = 65536
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

    def choice(self, key: str, *words: str) -> str:
        found = self.text(key)
        if found not in words:
            raise PageFault(f"{key} is not one of {', '.join(words)}")
        return found


def read_message(payload: bytes) -> tuple[str, Reader]:
    """Return a message's type and its fields; raises PageFault."""
    try:
        fields = decode_object(payload, MAX_MESSAGE_BYTES)
    except MalformedMessage as error:
        raise PageFault(error.reason) from None
    reader = Reader(fields)
    return reader.text("type", 32), reader
