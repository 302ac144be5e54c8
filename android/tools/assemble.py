"""Puts an APK together that lacks only its signature; its bytes depend on its contents alone.

``assemble.py RESOURCES DEX OUT``: RESOURCES is what aapt packed, DEX becomes classes.dex.
"""

from __future__ import annotations

import os
import sys
import zipfile
from pathlib import Path

from pack import add

# The system maps the table into memory; compressed files do not shrink again.
STORED = (".arsc", ".png", ".ogg")


def assemble(resources: Path, dex: Path, out: Path) -> None:
    """Write the entries of ``resources``, sorted, and the code to ``out``."""
    new = out.with_name(f"{out.name}.{os.getpid()}")
    try:
        with zipfile.ZipFile(resources) as packed, zipfile.ZipFile(new, "w") as written:
            for name in sorted(packed.namelist()):
                add(written, name, packed.read(name), stored=name.endswith(STORED))
            add(written, "classes.dex", dex.read_bytes())
        new.replace(out)
    finally:
        new.unlink(missing_ok=True)


if __name__ == "__main__":
    assemble(*(Path(each) for each in sys.argv[1:4]))
