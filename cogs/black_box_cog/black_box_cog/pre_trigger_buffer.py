"""Entries from before a flight, or from a time without a file, kept for the next file."""

from collections import deque
from collections.abc import Iterable

from black_box_cog.ingest_queue import Entry, LogLine

CAPACITY = 1000
"""This much from before a flight goes into its log."""
_MAX_LINES = 300


class PreTriggerBuffer:
    """The newest entries, and the older lines of the program's log."""

    def __init__(self) -> None:
        self._entries: deque[Entry] = deque()
        self._lines: deque[Entry] = deque(maxlen=_MAX_LINES)

    def add(self, entries: Iterable[Entry]) -> int:
        """Add entries; return how many Commands were dropped for them."""
        dropped = 0
        for entry in entries:
            if len(self._entries) >= CAPACITY:
                oldest = self._entries.popleft()
                if isinstance(oldest[1], LogLine):
                    self._lines.append(oldest)
                else:
                    dropped += 1
            self._entries.append(entry)
        return dropped

    @property
    def entries(self) -> list[Entry]:
        return [*self._lines, *self._entries]

    def clear(self) -> None:
        self._entries.clear()
        self._lines.clear()
