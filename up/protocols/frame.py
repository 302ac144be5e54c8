"""The output of a serial decoder, and its counters."""

from __future__ import annotations

from dataclasses import dataclass

Frame = tuple[int, bytes, int]
"""Type byte, payload, sequence (0 in thesis framing)."""

UNFINISHED_TIMEOUT_S = 0.1
"""Timeout of an unfinished frame (docs/protocols.md 2.1)."""

MAX_PAYLOAD = 96


@dataclass(slots=True)
class FrameCounters:
    """Counts since the decoder was created; they survive a reopened line."""

    frames: int = 0
    crc_errors: int = 0
    format_errors: int = 0
    unknown_types: int = 0
    lost_by_sequence: int = 0
    timeouts: int = 0


class SilenceTimer:
    """Reports when the newest byte is more than 100 ms old.

    Without a time in `on_bytes` the age counts from the next clock reading, which is later and so
    never drops a frame too early. Times are monotonic seconds.
    """

    __slots__ = ("_heard_s", "_is_fresh")

    def __init__(self) -> None:
        self._heard_s: float | None = None
        self._is_fresh = False

    def on_bytes(self, now: float | None) -> None:
        """Note that bytes arrived."""
        self._heard_s = now
        self._is_fresh = now is None

    def has_expired(self, now: float) -> bool:
        """Return whether the newest byte is too old for its frame to continue."""
        if self._is_fresh:
            self.on_bytes(now)
        # Added, not subtracted: a timer set for exactly this time must find it expired.
        return self._heard_s is not None and now >= self._heard_s + UNFINISHED_TIMEOUT_S
