"""The server's messages to pages, as bytes for a WebSocket."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping
from typing import Any

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
        """Return the message with its present age."""
        now_s = self._now_s()
        age_ms, sent_ms = self._age_s(now_s) * 1000, now_s * 1000
        return text_frame(b'%b%.1f,"sent_ms":%.1f}' % (self._body, age_ms, sent_ms))
