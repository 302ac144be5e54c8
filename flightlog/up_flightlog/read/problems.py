"""Problems of a log's files, counted by kind, so that even the longest list stays short."""

from __future__ import annotations

from dataclasses import dataclass

_MAX_KINDS = 50


@dataclass(frozen=True, slots=True)
class LogProblem:
    """A loss or damage; ``code`` is its kind, ``text`` one sentence that names file or topic."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text


class Problems:
    """The problems of one file; one entry per kind, however often it occurs."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._kinds: dict[tuple[str, str], list[int]] = {}
        self._others = 0

    def add(self, code: str, what: str, offset: int) -> None:
        """Add a problem ``what`` at that byte of the file."""
        known = self._kinds.get((code, what))
        if known is not None:
            known[1] += 1
        elif len(self._kinds) < _MAX_KINDS:
            self._kinds[code, what] = [offset, 1]
        else:
            self._others += 1

    def forget(self, code: str) -> None:
        for kind in [each for each in self._kinds if each[0] == code]:
            del self._kinds[kind]

    def all(self) -> list[LogProblem]:
        """Return one problem per kind, each naming the file and the first position."""
        found = []
        for (code, what), (offset, count) in self._kinds.items():
            times = f", {count} times" if count > 1 else ""
            found.append(LogProblem(code, f"{self.name}: {what} (at byte {offset}{times})"))
        if self._others:
            text = f"{self.name}: {self._others} problems of further kinds"
            found.append(LogProblem("more", text))
        return found
