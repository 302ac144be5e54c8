"""Lines that a program prints for its user, readable by programs too."""

from __future__ import annotations

import os
import time
from typing import Any

from twisted.logger import LogLevel

from up.log.json_lines import line_of
from up.log.setup import FORMAT_VARIABLE


def user_line(text: str, program: str, /, *, code: str = "", **fields: Any) -> str:
    """Return a line to print: the text, or JSON with code and fields if UP_LOG_FORMAT=json."""
    if os.environ.get(FORMAT_VARIABLE) != "json":
        return text
    event = {
        **fields,
        "code": code,
        "log_level": LogLevel.info,
        "log_namespace": program,
        "log_format": "{log_text}",
        "log_text": text,
        "log_time": time.time(),
    }
    return line_of(event, LogLevel.info).decode("ascii").rstrip("\n")
