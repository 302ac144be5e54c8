"""Maintains the logs and files of the instances."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from twisted.logger import Logger
from twisted.python.failure import Failure

from up_runner import keeping
from up_runner.host import Host

LOOK_S = 0.5


class Upkeep:
    """Rotates the logs of instances `in_use` and removes the oldest of the others beyond `kept`."""

    def __init__(self, host: Host, kept: int, in_use: Callable[[], Collection[str]]) -> None:
        self._host = host
        self._kept = kept
        self._in_use = in_use
        self._timer: Any = None
        self._busy = False
        self._failed = False
        self._log = Logger(namespace="runner")

    def start(self) -> None:
        """Start maintaining the logs."""
        self._timer = self._host.reactor.callLater(LOOK_S, self._look)

    def stop(self) -> None:
        """Stop."""
        timer, self._timer = self._timer, None
        if timer is not None and timer.active():
            timer.cancel()

    def prune(self) -> None:
        """Remove the files of the oldest ended instances."""
        self._host.on_disk(self._prune).addErrback(self._on_error)

    def _prune(self) -> None:
        folders = {self._host.run_folder.path, self._host.folder}
        keeping.prune(folders, self._host.logs, self._in_use(), self._kept)

    def _look(self) -> None:
        self._timer = self._host.reactor.callLater(LOOK_S, self._look)
        names = self._in_use()
        # At most one thread at a time, even if the disk takes longer than the period.
        if names and not self._busy:
            self._busy = True
            looking = self._host.in_thread(self._rotate, names)
            looking.addCallback(self._on_rotated).addErrback(self._on_error)

    def _rotate(self, names: Collection[str]) -> None:
        for name in names:
            self._host.logs.rotate(name)

    def _on_rotated(self, _: object) -> None:
        self._busy = self._failed = False

    def _on_error(self, failure: Failure) -> None:
        self._busy = False
        if failure.check(OSError) is None:
            self._log.failure("a bug in the runner", failure)
        elif not self._failed:
            self._failed = True
            self._log.error("the logs cannot be kept small: {error}", error=failure.value)
