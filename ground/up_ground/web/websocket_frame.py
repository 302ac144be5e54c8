"""A server's text message as it travels on a WebSocket (RFC 6455, 5.2)."""

from __future__ import annotations

import struct

_FINAL_TEXT = 0x81


def text_frame(payload: bytes) -> bytes:
    """Return the one frame of a text message, unmasked as a server's are; ``payload`` is UTF-8.

    Made here so that one message is put together once for all pages, and so that what has not
    left can still be replaced.
    """
    size = len(payload)
    if size < 126:
        return bytes((_FINAL_TEXT, size)) + payload
    if size < 65536:
        return struct.pack(">BBH", _FINAL_TEXT, 126, size) + payload
    return struct.pack(">BBQ", _FINAL_TEXT, 127, size) + payload
