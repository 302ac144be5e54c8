"""Extracts from an Android framework jar what its public stubs lack: java, javax, open packages.

``boot.py FRAMEWORK OUT``. The hidden classes beside them (``com.android.internal`` and others) stay
out, so that no code can be compiled against them.
"""

from __future__ import annotations

import os
import sys
import zipfile
from pathlib import Path

from pack import add

PACKAGES = (
    "java/",
    "javax/",
    "org/apache/http/",
    "org/json/",
    "org/w3c/",
    "org/xml/",
    "org/xmlpull/",
)


def boot(framework: Path, out: Path) -> None:
    """Write the classes of ``PACKAGES`` in ``framework`` to the jar ``out``."""
    new = out.with_name(f"{out.name}.{os.getpid()}")
    try:
        with zipfile.ZipFile(framework) as taken, zipfile.ZipFile(new, "w") as written:
            for name in sorted(taken.namelist()):
                if name.startswith(PACKAGES) and name.endswith(".class"):
                    add(written, name, taken.read(name))
        new.replace(out)
    finally:
        new.unlink(missing_ok=True)


if __name__ == "__main__":
    boot(Path(sys.argv[1]), Path(sys.argv[2]))
