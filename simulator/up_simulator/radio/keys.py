"""Turns a terminal's bytes into keys."""

from __future__ import annotations

_ARROWS = {ord("A"): "up", ord("B"): "down", ord("C"): "right", ord("D"): "left"}
_ESCAPE = 0x1B
_LONGEST = 16


class KeyReader:
    """Names arrows ``up``, ``down``, ``left``, ``right``; other keys are their letter.

    Other escape sequences, control characters and letters beyond ASCII are dropped. A sequence
    may arrive in pieces; at most 16 bytes of one are kept.
    """

    def __init__(self) -> None:
        self._sequence = bytearray()

    def feed(self, data: bytes) -> list[str]:
        """Return the keys that these bytes complete."""
        keys: list[str] = []
        for byte in data:
            key = self._take(byte)
            if key:
                keys.append(key)
        return keys

    def _take(self, byte: int) -> str:
        if byte == _ESCAPE:
            self._sequence = bytearray([byte])
            return ""
        if not self._sequence:
            return chr(byte) if 0x20 <= byte < 0x7F else ""
        if len(self._sequence) == 1 and byte not in b"[O":
            # The escape key itself, and then another key.
            self._sequence.clear()
            return self._take(byte)
        self._sequence.append(byte)
        is_final = len(self._sequence) > 2 and 0x40 <= byte <= 0x7E
        if not is_final and len(self._sequence) < _LONGEST:
            return ""
        # With a modifier it is ESC [ 1 ; 2 A: the arrow nevertheless.
        self._sequence.clear()
        return _ARROWS.get(byte, "") if is_final else ""
