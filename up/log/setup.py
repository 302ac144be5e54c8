"""Sets up the destinations of a program's log."""

import os
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TextIO, cast

from constantly import NamedConstant
from twisted.logger import (
    ILogObserver,
    LogBeginner,
    LogEvent,
    Logger,
    LogLevel,
    LogPublisher,
    globalLogBeginner,
    globalLogPublisher,
)

from up.log.json_lines import JsonLinesObserver, RotatingFile, line_of
from up.log.levels import level_named
from up.log.text import TextObserver, is_journal, journal_lines, terminal_lines
from up.output import FORMAT_VARIABLE


class Logging:
    """The log of a running program, until `stop`."""

    def __init__(
        self,
        publisher: LogPublisher,
        observers: Sequence[ILogObserver],
        json_lines: JsonLinesObserver | None,
    ) -> None:
        self._publisher = publisher
        self._observers = observers
        self._json_lines = json_lines

    def stop(self) -> None:
        for observer in self._observers:
            self._publisher.removeObserver(observer)
        if self._json_lines is not None:
            self._json_lines.stop()


def start_logging(
    level: str = "info",
    stream: TextIO | None = None,
    json_path: Path | None = None,
    rotate_bytes: int = 5_000_000,
    keep: int = 5,
    *,
    environ: Mapping[str, str] = os.environ,
    beginner: LogBeginner = globalLogBeginner,
    publisher: LogPublisher = globalLogPublisher,
) -> Logging:
    """Send events of `level` and above to `stream` (stderr) and, as JSON lines, to `json_path`.

    At `rotate_bytes` the file is renamed and a new one started; `keep` old ones stay. A program
    that reads another one's log starts it with UP_LOG_FORMAT=json: `stream` gets JSON lines, too.
    Raises ValueError for an unknown level. Write errors are not raised: after one the file is no
    longer written, which the stream reports once. `beginner` and `publisher` belong together.
    """
    least = level_named(level)
    stream = sys.stderr if stream is None else stream
    if environ.get(FORMAT_VARIABLE) == "json":
        lines_of = json_lines_of
    else:
        lines_of = journal_lines if is_journal(stream, environ) else terminal_lines
    text = TextObserver(stream, least, lines_of)
    observers = [cast(ILogObserver, text)]
    json_lines = None
    if json_path is not None:
        file = RotatingFile(json_path, rotate_bytes, keep)
        json_lines = JsonLinesObserver(file, least, lambda what: _log_directly(text, what))
        observers.append(cast(ILogObserver, json_lines))
        json_lines.start()
    beginner.beginLoggingTo(observers, redirectStandardIO=False)
    return Logging(publisher, observers, json_lines)


def json_lines_of(event: LogEvent, least: NamedConstant) -> Iterator[str]:
    """Format an event as the line of JSON that the log file gets."""
    yield line_of(event, least).decode("ascii").rstrip("\n")


def _log_directly(observer: TextObserver, what: str) -> None:
    """Write directly to the stream, bypassing the publisher that is handling an event."""
    observer(
        {
            "log_level": LogLevel.error,
            "log_namespace": "up.log",
            "log_format": "{what}",
            "log_time": time.time(),
            "what": what,
            "code": "log_file_failed",
        }
    )


class UpLogger:
    """Creates loggers by name."""

    @classmethod
    def get_logger(cls, name: str = "up") -> Logger:
        """Return a logger whose events carry `name`."""
        return Logger(namespace=name)
