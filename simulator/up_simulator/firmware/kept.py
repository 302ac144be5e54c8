"""Files that are made once and kept for the next start, beside the rig's build."""

from __future__ import annotations

import os
from pathlib import Path

from up_rig.library import library_path


def cache_path(folder: str, name: str) -> Path:
    """Return where a file of this name is kept; it need not exist."""
    return library_path().parent / folder / name


def keep(path: Path, content: bytes) -> None:
    """Write the file atomically; other processes may write the same one now."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f"{path.name}.{os.getpid()}.new")
    fresh.write_bytes(content)
    fresh.replace(path)
