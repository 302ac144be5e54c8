"""The output of a serial decoder, and its counters."""

from up.quick_dataclass import dataclass

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
