"""Maintains the logs and files of the instances, and limits those of ended ones."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Callable, Collection
from pathlib import Path

from twisted.internet.defer import Deferred
from twisted.internet.task import LoopingCall
from twisted.logger import Logger
from twisted.python.failure import Failure

from up_runner.instance_host import InstanceHost
from up_runner.log_keeper import LogKeeper
from up_runner.request import NAME

PERIOD_S = 0.5
_CONTENTS = frozenset(
    ("notify", "state.json", ".state.json.tmp", "deadline", ".deadline.tmp", "config", "profile")
)
"""All names that a runner creates in an instance's folder."""


class LogMaintenance:
    """Rotates the logs of instances `in_use` and removes the oldest of the others beyond `kept`."""

    def __init__(
        self, host: InstanceHost, kept: int, in_use: Callable[[], Collection[str]]
    ) -> None:
        self._host = host
        self._kept = kept
        self._in_use = in_use
        self._failed = False
        # At most one thread at a time, even if the disk takes longer than the period.
        self._loop = LoopingCall(self._run)
        self._loop.clock = host.reactor
        self._log = Logger(namespace="runner")

    def start(self) -> None:
        self._loop.start(PERIOD_S, now=False)

    def stop(self) -> None:
        if self._loop.running:
            self._loop.stop()

    def prune(self) -> None:
        self._host.on_disk(self._prune).addErrback(self._on_error)

    def _prune(self) -> None:
        folders = {self._host.run_folder.path, self._host.folder}
        prune(folders, self._host.logs, self._in_use(), self._kept)

    def _run(self) -> Deferred[None] | None:
        names = self._in_use()
        if not names:
            return None
        rotating = self._host.in_thread(self._rotate, names)
        return rotating.addCallback(self._on_rotated).addErrback(self._on_error)

    def _rotate(self, names: Collection[str]) -> None:
        for name in names:
            self._host.logs.rotate(name)

    def _on_rotated(self, _: object) -> None:
        self._failed = False

    def _on_error(self, failure: Failure) -> None:
        if failure.check(OSError) is None:
            self._log.failure("a bug in the runner", failure, code="runner_bug")
        elif not self._failed:
            self._failed = True
            text = "cannot rotate or remove logs: {error}"
            self._log.error(text, code="log_maintenance_failed", error=str(failure.value))


def _remains(folders: Collection[Path]) -> set[str]:
    """Return the names of all instances that have a folder.

    A folder with other content does not belong to the runner, whatever its name: the configured
    folder may be shared.
    """
    names: set[str] = set()
    for folder in folders:
        with contextlib.suppress(OSError):
            names |= {each.name for each in folder.iterdir() if _is_ours(each)}
    return names


def prune(folders: Collection[Path], logs: LogKeeper, in_use: Collection[str], keep: int) -> None:
    """Remove all but the `keep` latest ended instances; blocks on the disk.

    Instances `in_use` stay and do not count. Their logs are removed with them.
    """
    ended = [name for name in _remains(folders) if name not in in_use]
    ended.sort(key=lambda name: (max(logs.newest_s(name), _newest_s(folders, name)), name))
    for name in ended[: max(0, len(ended) - keep)]:
        for folder in folders:
            if _is_ours(folder / name):
                shutil.rmtree(folder / name, ignore_errors=True)
        logs.remove(name)


def _is_ours(path: Path) -> bool:
    if NAME.fullmatch(path.name) is None or path.is_symlink():
        return False
    try:
        return all(each.name in _CONTENTS for each in path.iterdir())
    except OSError:
        return False


def _newest_s(folders: Collection[Path], name: str) -> float:
    newest_s = 0.0
    for folder in folders:
        with contextlib.suppress(OSError):
            newest_s = max(newest_s, (folder / name).stat().st_mtime)
    return newest_s
