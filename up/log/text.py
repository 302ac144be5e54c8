"""Formats events as lines for people and for the journal."""

import os
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from typing import TextIO

from constantly import NamedConstant
from twisted.logger import ILogObserver, LogEvent, LogLevel, formatEvent
from zope.interface import implementer

from up.fields import printable
from up.log.levels import level_of, priority_of, word_of

_MAX_TEXT = 4000


def source_of(event: LogEvent) -> str:
    """Return the logger's name."""
    source = _short(str(event.get("log_namespace") or "-"))
    if source == "log_legacy":
        source = event.get("log_system") or "-"
    return printable(str(source))


def text_of(event: LogEvent) -> str:
    """Return an event's text, in one line without control characters, at most 4000 characters.

    Appends the message of an expected failure (logged below critical).
    """
    text = formatEvent(event)
    failure = event.get("log_failure")
    if failure is not None:
        reason = failure.getErrorMessage() or failure.type.__name__
        if reason not in text:
            text = f"{text}: {reason}" if text else reason
    if len(text) > _MAX_TEXT:
        text = text[:_MAX_TEXT] + "..."
    return printable(text)


def traceback_of(event: LogEvent, least: NamedConstant) -> str:
    """Return the traceback of a bug, or of any failure at level debug; otherwise ''."""
    failure = event.get("log_failure")
    if failure is None or (least > LogLevel.debug and level_of(event) < LogLevel.critical):
        return ""
    return str(failure.getTraceback())


def is_journal(stream: TextIO | None, environ: Mapping[str, str]) -> bool:
    """Return whether the stream leads to systemd's journal (sd-daemon: JOURNAL_STREAM).

    The variable survives a redirection, so its device and inode must match the stream's.
    """
    named = environ.get("JOURNAL_STREAM")
    if stream is None or not named:
        return False
    try:
        status = os.fstat(stream.fileno())
    except (OSError, ValueError):
        return False
    return named == f"{status.st_dev}:{status.st_ino}"


@implementer(ILogObserver)
class TextObserver:
    """Writes every event of level `least` and above to a stream, thread-safe.

    A line that the stream refuses is lost; nothing is raised. The stream is None for a program that
    was started with its stderr closed.
    """

    def __init__(
        self,
        stream: TextIO | None,
        least: NamedConstant,
        lines_of: Callable[[LogEvent, NamedConstant], Iterator[str]],
    ) -> None:
        self._stream = stream
        self._least = least
        self._lines_of = lines_of
        self._lock = threading.Lock()

    def __call__(self, event: LogEvent) -> None:
        """Write the event if it is severe enough."""
        if self._stream is not None and level_of(event) >= self._least:
            self._write(
                self._stream, "".join(f"{line}\n" for line in self._lines_of(event, self._least))
            )

    def _write(self, stream: TextIO, text: str) -> None:
        with self._lock:
            try:
                try:
                    stream.write(text)
                except UnicodeEncodeError:
                    stream.write(text.encode("ascii", "backslashreplace").decode())
                stream.flush()
            except (OSError, ValueError):
                # The stream is full, broken or closed: the error cannot be reported.
                return


def terminal_lines(event: LogEvent, least: NamedConstant) -> Iterator[str]:
    """Format an event for a terminal: time, level, source, text."""
    head = f"{_clock_text(event)} {word_of(level_of(event)):<8}"
    yield f"{head} {source_of(event)}: {text_of(event)}"
    for line in traceback_of(event, least).splitlines():
        yield f"    {printable(line)}"


def journal_lines(event: LogEvent, least: NamedConstant) -> Iterator[str]:
    """Format an event for systemd's journal, which adds the time: priority, source, text."""
    head = f"<{priority_of(level_of(event))}>"
    yield f"{head}{source_of(event)}: {text_of(event)}"
    for line in traceback_of(event, least).splitlines():
        yield f"{head}    {printable(line)}"


def _clock_text(event: LogEvent) -> str:
    moment = event.get("log_time", 0.0)
    milliseconds = int(moment * 1000) % 1000
    return f"{time.strftime('%H:%M:%S', time.localtime(moment))}.{milliseconds:03d}"


def _short(namespace: str) -> str:
    """Return a class's bare name, the display name of a module; other names stay whole."""
    last = namespace.rpartition(".")[2]
    return last if last[:1].isupper() else namespace
