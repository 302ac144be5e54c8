"""The log of a program of the simulator: lines for the user, codes and fields for programs."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Protocol

from up.output import FORMAT_VARIABLE, program_line

JSON_ENVIRONMENT = {FORMAT_VARIABLE: "json"}
"""Makes a program of the project log JSON lines, which ``read_line`` reads."""


class Log(Protocol):
    """Takes one line for the user; ``code`` and fields identify it to programs."""

    def __call__(self, text: str, /, *, code: str = "", **fields: Any) -> None:
        """Log the line."""


def no_log(_text: str, /, *, code: str = "", **_fields: Any) -> None:
    """Discard the line."""


def text_log(write: Callable[[str], None]) -> Log:
    """Return a log that passes on the texts only."""

    def log(text: str, /, *, code: str = "", **_fields: Any) -> None:
        write(text)

    return log


def print_line(text: str, /, *, code: str = "", **fields: Any) -> None:
    """Print a line, or JSON with its code and fields if ``UP_LOG_FORMAT=json``."""
    line = program_line(text, code, fields) or text
    # The terminal may be closed already.
    with suppress(OSError):
        sys.stdout.write(f"{line}\n")
        sys.stdout.flush()


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line of a program's log; ``code`` is empty for output that is not of its log."""

    text: str
    code: str = ""
    fields: Mapping[str, Any] = field(default_factory=dict)
    traceback: str = ""

    def has(self, code: str, **fields: Any) -> bool:
        return self.code == code and all(
            self.fields.get(name) == value for name, value in fields.items()
        )


def read_line(line: str) -> LogLine:
    """Return a line of a log of either form."""
    if line.startswith("{"):
        with suppress(ValueError, TypeError, KeyError):
            found = json.loads(line)
            fields = found.get("fields", {})
            code = str(fields.get("code", ""))
            return LogLine(str(found["text"]), code, fields, str(found.get("traceback", "")))
    return LogLine(line)
