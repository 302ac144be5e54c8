"""The output of command line programs: text for people, JSON lines for other programs."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Mapping
from typing import Any, Protocol

from up.errors import Problem, UserError
from up.fields import printable

FORMAT_VARIABLE = "UP_LOG_FORMAT"
"""In the environment of a program: ``json`` for output and log that another program reads."""
_FORMATS = ("text", "json")


class Echo(Protocol):
    """Shows a line of progress, with the code and fields that a program reads."""

    def __call__(self, text: str, /, code: str = "", **fields: Any) -> None: ...


def echo(text: str, /, code: str = "", **fields: Any) -> None:
    """Show a line on stdout: an event if it has a code, otherwise a line of the answer itself."""
    line = program_line(text, code, fields) if code else None
    print(line or text, flush=True)  # noqa: T201


def print_problems(problems: Iterable[Problem], level: str = "error") -> None:
    """Show problems on stderr, each once; a warning's text begins with its level."""
    head = "" if level == "error" else f"{level}: "
    for text, each in {str(each): each for each in problems}.items():
        line = program_line(text, each.code, each.fields, level) or _shown(f"{head}{text}")
        print(line, file=sys.stderr)  # noqa: T201 - the user's answer


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
