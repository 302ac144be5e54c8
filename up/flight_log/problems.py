"""Problems of a log's files, counted by kind, so that even the longest list stays short."""

from __future__ import annotations

_MOST_KINDS = 50


class Problems:
    """Sentences about one file; one sentence per kind, however often it occurs."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._kinds: dict[str, list[int]] = {}
        self._others = 0

    def note(self, what: str, offset: int) -> None:
        """Note a problem ``what`` at that byte of the file."""
        known = self._kinds.get(what)
        if known is not None:
            known[1] += 1
        elif len(self._kinds) < _MOST_KINDS:
            self._kinds[what] = [offset, 1]
        else:
            self._others += 1

    @property
    def sentences(self) -> list[str]:
        """Return one sentence per kind, each naming the file and the first position."""
        told = [
            f"{self.name}: {what} (at byte {offset}{f', {count} times' if count > 1 else ''})"
            for what, (offset, count) in self._kinds.items()
        ]
        if self._others:
            told.append(f"{self.name}: {self._others} problems of further kinds")
        return told
