"""Packs a folder into a jar or zip whose bytes depend only on its contents."""

from __future__ import annotations

import os
import sys
import zipfile
from pathlib import Path

# The earliest time that a zip can store.
THE_TIME = (1980, 1, 1, 0, 0, 0)


def pack(archive: Path, folder: Path) -> None:
    """Write every file of ``folder`` into ``archive``, sorted, compressed, with one fixed time.

    The archive appears only when it is complete.
    """
    names = sorted(each.relative_to(folder).as_posix() for each in folder.rglob("*"))
    new = archive.with_name(f"{archive.name}.{os.getpid()}")
    try:
        with zipfile.ZipFile(new, "w") as out:
            for name in names:
                if not (folder / name).is_dir():
                    add(out, name, (folder / name).read_bytes())
        new.replace(archive)
    finally:
        new.unlink(missing_ok=True)


def add(out: zipfile.ZipFile, name: str, content: bytes, stored: bool = False) -> None:
    """Add one file with the fixed time; ``stored`` is without compression."""
    entry = zipfile.ZipInfo(name, THE_TIME)
    entry.external_attr = 0o644 << 16
    entry.create_system = 3
    method = zipfile.ZIP_STORED if stored else zipfile.ZIP_DEFLATED
    out.writestr(entry, content, method, 9)


if __name__ == "__main__":
    pack(Path(sys.argv[1]), Path(sys.argv[2]))
