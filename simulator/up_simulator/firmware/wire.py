"""The messages of the serial line in checked framing, by their type letters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from up.protocols import checked_framing
from up.protocols.checked_framing import CheckedDecoder

COMMAND_SIZES = {
    "s": 0, "a": 0, "d": 0, "M": 1, "m": 0, "p": 3, "g": 72, "G": 0, "u": 10,
    "S": 10, "R": 10, "v": 1, "C": 54, "c": 0, "e": 1, "V": 2, "A": 2,
}  # fmt: skip
"""Payload bytes of every Command from the Raspberry Pi (protocols 2.3)."""


@dataclass(frozen=True, slots=True)
class Command:
    """A message as received: its type letter, payload and, if framed, its sequence."""

    type: str
    payload: bytes
    sequence: int = 0


def checked_frame(sequence: int, type_letter: str, payload: bytes = b"") -> bytes:
    """Return one frame of checked framing with its end mark."""
    return checked_framing.checked_frame(sequence, ord(type_letter), payload)


class CheckedReader:
    """Finds messages of these sizes in a stream; ``counters`` has the invalid frames."""

    def __init__(self, sizes: Mapping[str, int] = COMMAND_SIZES) -> None:
        self._decoder = CheckedDecoder({ord(letter): size for letter, size in sizes.items()})
        self.counters = self._decoder.counters

    def feed(self, data: bytes, now_s: float) -> list[Command]:
        """Take bytes received at ``now_s``; return the messages that they complete."""
        found = self._decoder.feed(data, now_s)
        return [Command(chr(type_), payload, sequence) for type_, payload, sequence in found]
