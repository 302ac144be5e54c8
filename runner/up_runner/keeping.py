"""Limits the files that ended instances leave on the disk."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Collection
from pathlib import Path

from up_runner.log_keeper import LogKeeper
from up_runner.request import NAME

# All names that a runner creates in an instance's folder.
_CONTENTS = frozenset(("notify", "state.json", ".state.json.tmp", "config", "profile"))


def remains(folders: Collection[Path]) -> set[str]:
    """Return the names of all instances that have a folder.

    A folder with other content does not belong to the runner, whatever its name: the configured
    folder may be shared.
    """
    names: set[str] = set()
    for folder in folders:
        with contextlib.suppress(OSError):
            names |= {each.name for each in folder.iterdir() if _is_ours(each)}
    return names


def prune(
    folders: Collection[Path], logs: LogKeeper, in_use: Collection[str], keep: int
) -> list[str]:
    """Remove all but the `keep` latest ended instances, and return their names; blocks on the disk.

    Instances `in_use` stay and do not count. Their logs are removed with them.
    """
    ended = [name for name in remains(folders) if name not in in_use]
    ended.sort(key=lambda name: (max(logs.newest_s(name), _newest_s(folders, name)), name))
    gone = ended[: max(0, len(ended) - keep)]
    for name in gone:
        for folder in folders:
            if _is_ours(folder / name):
                shutil.rmtree(folder / name, ignore_errors=True)
        logs.remove(name)
    return gone


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
