"""What the Java phone says, as sentences for a person."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def sentence_of(event: Mapping[str, Any]) -> str | None:
    """Return what an event of the virtual phone is in plain words; None: nothing to say."""
    match event.get("event"):
        case "connected":
            return f"connected to {event.get('host')}:{event.get('general')}"
        case "lost":
            return str(event.get("reason"))
        case "says":
            return f"says: {event.get('text')!r}"
        case "panic":
            delay_ms = event.get("delay_ms")
            return f"busy: nothing quicker than {delay_ms} ms" if delay_ms else "not busy any more"
        case "notice":
            return str(event.get("text"))
    return None
