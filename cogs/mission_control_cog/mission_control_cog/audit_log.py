"""Who did what: the outcome of every Command from the ground, as lines of JSON."""

import json
import time
from collections.abc import Set
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from twisted.logger import Logger
from twisted.python.failure import Failure

from up.commands.answer_commands import CommandAnsweredCommand
from up.log.json_lines import RotatingFile
from up.system.disk_thread import DiskThread
from up.system.token_bucket import TokenBucket

_ROTATE_BYTES = 1_000_000
_KEEP = 4
_STRANGERS_HZ, _STRANGERS_BURST = 0.2, 60
"""Outcomes without a key: a flood of them must not push those of keys out of the files."""


class AuditLog:
    """Writes outcomes beside the reactor; their publisher limits their rate.

    A failed write ends it, and is logged: it never delays or refuses a Command.
    """

    log = Logger()

    def __init__(self, reactor: Any, path: Path, links: Set[str]) -> None:
        self._file = RotatingFile(path, _ROTATE_BYTES, _KEEP)
        self._links = links
        self._disk = DiskThread(reactor)
        self._strangers = TokenBucket(reactor, _STRANGERS_HZ, _STRANGERS_BURST)
        self._waiting: list[bytes] = []
        self._is_writing = True
        self._is_open = True
        self._disk.run(self._file.open).addCallbacks(self._write, self._on_failed)

    def on_answered(self, command: CommandAnsweredCommand) -> None:
        if not self._is_open or command.link not in self._links:
            return
        if not command.key and not self._strangers.take():
            return
        moment = datetime.fromtimestamp(time.time(), UTC).isoformat(timespec="milliseconds")
        self._waiting.append(json.dumps({"time": moment, **command.data}).encode() + b"\n")
        if not self._is_writing:
            self._write(None)

    def close(self) -> None:
        """Close the file as soon as all outcomes are written."""
        self._is_open = False
        if not self._is_writing:
            self._file.close()

    def _write(self, _: object) -> None:
        """Write what waits, in order: one piece of work at a time."""
        lines, self._waiting = self._waiting, []
        self._is_writing = bool(lines)
        if lines:
            work = self._disk.run(lambda: self._file.write(b"".join(lines)))
            work.addCallbacks(self._write, self._on_failed)
        elif not self._is_open:
            self._file.close()

    def _on_failed(self, failure: Failure) -> None:
        if self._is_open:
            self._is_open = False
            self.log.error(
                "cannot write {path}, the audit log stops: {reason}",
                path=str(self._file.path),
                reason=failure.getErrorMessage(),
                code="audit_failed",
            )
