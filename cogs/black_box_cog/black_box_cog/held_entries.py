"""What was said before a flight, or while there is no file, kept for the file to come."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from black_box_cog.intake import Entry, LogLine

HELD = 1000
"""So much of what was said before a flight goes into its log."""
_HELD_LINES = 300


class HeldEntries:
    """The newest entries, and of those before them the lines of the program's log."""

    def __init__(self) -> None:
        self._entries: deque[Entry] = deque()
        self._lines: deque[Entry] = deque(maxlen=_HELD_LINES)

    def hold(self, entries: Iterable[Entry]) -> int:
        """Take what came; return how many Commands had to go for it."""
        gone = 0
        for entry in entries:
            if len(self._entries) >= HELD:
                oldest = self._entries.popleft()
                if isinstance(oldest[1], LogLine):
                    self._lines.append(oldest)
                else:
                    gone += 1
            self._entries.append(entry)
        return gone

    @property
    def all(self) -> list[Entry]:
        """Return them in the order in which they came."""
        return [*self._lines, *self._entries]

    def clear(self) -> None:
        """Hold nothing any more: it is written."""
        self._entries.clear()
        self._lines.clear()
