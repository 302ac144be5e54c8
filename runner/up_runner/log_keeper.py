"""Bounded logs for instances that write to their files themselves.

An instance outlives its runner, so its output cannot go through a pipe to the runner: in flight it
would die of the broken pipe, or lose its log. It holds its file open for appending; when the file
is too long, the runner copies its end and truncates it.
"""

from __future__ import annotations

import contextlib
import os
import re
from pathlib import Path

_END = 16384
_SHOWN = 200
_SHOWN_LINES = 3
# A line of Up's own log; a plain error message of a program that exits has no time.
_LOGGED = re.compile(
    r"(?:\d\d:\d\d:\d\d\.\d{3} (DEBUG|INFO|WARNING|ERROR|CRITICAL)|<([2-7])>)\s*(.*)", re.ASCII
)
_QUIET = ("DEBUG", "INFO", "7", "6", "5")
_WARNING = ("WARNING", "4")


class LogKeeper:
    """The logs of all instances: `<name>.log` and up to `keep` older ones, `.1` the newest.

    Each has at most `size` bytes, plus what an instance writes between two calls of `rotate`. Every
    method may block on the disk: call them from a thread.
    """

    def __init__(self, folder: Path, size: int, keep: int) -> None:
        self.folder = folder
        self._size = size
        self._keep = keep
        self._begins: dict[str, int] = {}

    def path(self, name: str) -> Path:
        return self.folder / f"{name}.log"

    def open(self, name: str) -> int:
        """Return a descriptor that appends to an instance's log; raises OSError."""
        self.folder.mkdir(mode=0o750, parents=True, exist_ok=True)
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
        log = os.open(self.path(name), flags, 0o640)
        self._begins[name] = os.fstat(log).st_size
        return log

    def rotate(self, name: str) -> bool:
        """Rotate the log if it is too long and return whether it was; raises OSError.

        Truncates even if the disk is too full for a copy: that frees the space.
        """
        path = self.path(name)
        try:
            size = path.stat().st_size
        except FileNotFoundError:
            return False
        if size < self._size:
            return False
        try:
            if self._keep:
                self._copy_end(path)
        finally:
            os.truncate(path, 0)
            self._begins.pop(name, None)
        return True

    def last_log_line(self, name: str) -> str | None:
        """Return the reason for an instance's end, from the log since it was last opened."""
        begin = self._begins.get(name, 0)
        try:
            with self.path(name).open("rb") as file:
                end = file.seek(0, os.SEEK_END)
                begin = max(begin if begin <= end else 0, end - _END)
                file.seek(begin)
                text = file.read().decode("utf-8", "replace")
        except OSError:
            return None
        return last_log_line(text)

    def newest_s(self, name: str) -> float:
        """Return the wall clock time of the last write to an instance's log; 0 without a log."""
        try:
            return self.path(name).stat().st_mtime
        except OSError:
            return 0.0

    def remove(self, name: str) -> None:
        self._begins.pop(name, None)
        pattern = re.compile(re.escape(name) + r"\.log(\.[0-9]+)?")
        for path in list(self.folder.glob(f"{name}.log*")):
            if pattern.fullmatch(path.name):
                with contextlib.suppress(OSError):
                    path.unlink()

    def _copy_end(self, path: Path) -> None:
        for number in range(self._keep - 1, 0, -1):
            with contextlib.suppress(FileNotFoundError):
                self._older(path, number).replace(self._older(path, number + 1))
        with path.open("rb") as source:
            end = source.seek(0, os.SEEK_END)
            source.seek(max(0, end - self._size))
            self._older(path, 1).write_bytes(source.read(self._size))

    def _older(self, path: Path, number: int) -> Path:
        return path.with_name(f"{path.name}.{number}")


def last_log_line(text: str) -> str | None:
    """Return the most informative part of a log's end, in one bounded line.

    Plain sentences come first (consecutive ones are joined), then the last error, then the last
    warning, then the last line.
    """
    plain: list[str] = []
    found: dict[str, str] = {}
    is_block_open = False
    for line in text.splitlines():
        logged = _LOGGED.match(line)
        if logged is not None:
            level, message = logged[1] or logged[2], logged[3]
            kind = "quiet" if level in _QUIET else "warning" if level in _WARNING else "error"
            found[kind] = message
            is_block_open = False
        # An indented line belongs to the line above, usually to a traceback.
        elif line.strip() and not (line[0].isspace() or line.startswith("Traceback (")):
            plain = [*(plain if is_block_open else ()), line.strip()][-_SHOWN_LINES:]
            is_block_open = True
    if plain:
        return "; ".join(_shown(each) for each in plain)
    message = found.get("error") or found.get("warning") or found.get("quiet") or ""
    return _shown(message) if message else None


def _shown(line: str) -> str:
    shown = "".join(letter if letter.isprintable() else "?" for letter in line)
    return shown if len(shown) <= _SHOWN else shown[: _SHOWN - 3] + "..."
