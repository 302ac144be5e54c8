"""What ended instances leave on the disk, and how much of it stays."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Collection
from pathlib import Path

from up_runner.log_keeper import LogKeeper


def remains(folders: Collection[Path], logs: LogKeeper) -> set[str]:
    """Return the names of all instances that have a folder or a log."""
    names = logs.names()
    for folder in folders:
        with contextlib.suppress(OSError):
            names |= {
                each.name
                for each in folder.iterdir()
                if each.is_dir() and not each.is_symlink() and not each.name.startswith(".")
            }
    return names


def prune(
    folders: Collection[Path], logs: LogKeeper, in_use: Collection[str], keep: int
) -> list[str]:
    """Remove all but the `keep` latest ended instances, and return whom; waits for the disk.

    `in_use` are left alone and not counted.
    """
    ended = [name for name in remains(folders, logs) if name not in in_use]
    ended.sort(key=lambda name: (max(logs.newest_s(name), _newest_s(folders, name)), name))
    gone = ended[: max(0, len(ended) - keep)]
    for name in gone:
        for folder in folders:
            shutil.rmtree(folder / name, ignore_errors=True)
        logs.remove(name)
    return gone


def _newest_s(folders: Collection[Path], name: str) -> float:
    newest_s = 0.0
    for folder in folders:
        with contextlib.suppress(OSError):
            newest_s = max(newest_s, (folder / name).stat().st_mtime)
    return newest_s
