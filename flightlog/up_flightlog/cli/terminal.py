"""The terminal output of the verbs: warnings, progress."""

from __future__ import annotations

import sys
from typing import Self

from up.output import StatusLine
from up_flightlog.read.flight_log import FlightLog

_DELAY_S = 0.5


def warn(text: str) -> None:
    """Show a line that is not part of the answer."""
    print(text, file=sys.stderr)  # noqa: T201 - the user's answer


class Progress:
    """Shows one line on a terminal once the operation has taken half a second.

    Use it as a context: the line is removed at the end. Prints nothing to a file or a pipe.
    """

    def __init__(self, text: str) -> None:
        self._text = text
        self._line = StatusLine(period_s=0.1, delay_s=_DELAY_S)

    def show(self, done: str) -> None:
        self._line.show(f"{self._text} {done}")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self._line.clear()


class DecodingProgress(Progress):
    """Shows how many messages of a log were decoded, as ``text, 120000 messages``."""

    def __init__(self, text: str, log: FlightLog) -> None:
        super().__init__(f"{text},")
        self._log = log
        self._count = 0

    def _on_decoded(self, count: int) -> None:
        self._count += count
        self.show(f"{self._count} messages")

    def __enter__(self) -> Self:
        self._log.on_decoded = self._on_decoded
        return self

    def __exit__(self, *error: object) -> None:
        self._log.on_decoded = None
        super().__exit__(*error)
