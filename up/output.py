"""The output of command line programs: text for people, JSON lines for other programs."""

import json
import os
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any, TextIO

from up.errors import Problem, UserError
from up.fields import printable

FORMAT_VARIABLE = "UP_LOG_FORMAT"
"""In the environment of a program: ``json`` for output and log that another program reads."""
_FORMATS = ("text", "json")


def echo(text: str, /, code: str = "", **fields: Any) -> None:
    """Show a line on stdout: an event if it has a code, otherwise a line of the answer itself."""
    line = program_line(text, code, fields) if code else None
    _print_line(line or text, sys.stdout)


def print_problems(problems: Iterable[Problem], level: str = "error") -> None:
    """Show problems on stderr, each once; a warning's text begins with its level."""
    head = "" if level == "error" else f"{level}: "
    for text, each in {str(each): each for each in problems}.items():
        line = program_line(text, each.code, each.fields, level) or _shown(f"{head}{text}")
        _print_line(line, sys.stderr)


def _print_line(line: str, stream: TextIO) -> None:
    # One write: a thread that logs cannot come between a line and its end.
    print(f"{line}\n", end="", file=stream, flush=True)


def table(head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Return lines with aligned columns; those numbered in ``right`` are right-aligned.

    Control characters are escaped.
    """
    cells = [[printable(cell) for cell in row] for row in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = []
    for row in cells:
        parts = [
            cell.rjust(width) if number in right else cell.ljust(width)
            for number, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(parts).rstrip())
    return "\n".join(lines)


class StatusLine:
    """A line of a terminal (default: stderr) that is rewritten; elsewhere nothing is shown."""

    def __init__(
        self,
        stream: TextIO | None = None,
        *,
        period_s: float = 0.2,
        delay_s: float = 0.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._stream = stream
        self._period_s = period_s
        self._clock = clock
        self._due_s = clock() + delay_s
        self._is_shown = False

    @property
    def is_terminal(self) -> bool:
        return (self._stream or sys.stderr).isatty()

    def show(self, text: str) -> None:
        """Show a text, at most once in ``period_s`` and not before ``delay_s``."""
        now_s = self._clock()
        if now_s >= self._due_s:
            self._due_s = now_s + self._period_s
            if self.is_terminal:
                self._is_shown = True
                self._write(f"\r\x1b[K{text}")

    def clear(self) -> None:
        if self._is_shown:
            self._is_shown = False
            self._write("\r\x1b[K")

    def print(self, text: str) -> None:
        """Print a line that stays, on any stream."""
        self.clear()
        self._write(f"{text}\n")

    def _write(self, text: str) -> None:
        # The terminal may be closed already.
        with suppress(OSError):
            stream = self._stream or sys.stderr
            stream.write(text)
            stream.flush()


def check_format() -> None:
    """Raise UserError for an unknown value of UP_LOG_FORMAT."""
    value = os.environ.get(FORMAT_VARIABLE)
    if value and value not in _FORMATS:
        text = f"{FORMAT_VARIABLE}={value!r} must be {' or '.join(_FORMATS)}"
        raise UserError(text, "log_format_unknown", value=value)


def wants_json() -> bool:
    """Return whether another program reads the output."""
    return os.environ.get(FORMAT_VARIABLE) == "json"


def program_line(
    text: str, code: str, fields: Mapping[str, object], level: str = "info"
) -> str | None:
    """Return a line of a program's own output as JSON with its code; None if text is wanted."""
    if not wants_json():
        return None
    record = {"level": level, "text": text, "fields": {"code": code, **fields}}
    return json.dumps(record, default=str)


def program_error(program: str, text: str, code: str, **fields: object) -> str:
    """Return the line with which a program reports an error: JSON, or its name and the text."""
    return program_line(text, code, fields, "error") or _shown(f"{program}: {text}")


def _shown(text: str) -> str:
    """Return lines with every non-printable character escaped."""
    return "\n".join(map(printable, text.split("\n")))
