"""Pictures of the map on disk: each is fetched once, and a flight without network has them."""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
from collections.abc import Mapping
from pathlib import Path

BYTES_LIMIT = 200_000_000
_KEEP_SHARE = 0.8


def cache_folder(environ: Mapping[str, str]) -> Path:
    """Return where tiles are kept: ``$XDG_CACHE_HOME/up-ground/tiles``, or ``~/.cache``'s."""
    home = environ.get("XDG_CACHE_HOME", "")
    base = Path(home) if home.startswith("/") else Path.home() / ".cache"
    return base / "up-ground" / "tiles"


class TileCache:
    """Tiles of one source, bounded in all; where nothing can be stored nothing is."""

    def __init__(self, folder: Path, source: str, limit: int = BYTES_LIMIT) -> None:
        self._folder = folder / hashlib.sha256(source.encode()).hexdigest()[:16]
        self._limit = limit
        self._bytes: int | None = None

    def get(self, z: int, x: int, y: int) -> bytes | None:
        """Return a tile; None: it is not here."""
        with contextlib.suppress(OSError):
            path = self._path(z, x, y)
            content = path.read_bytes()
            # What is used stays longest.
            os.utime(path)
            return content
        return None

    def put(self, z: int, x: int, y: int, content: bytes) -> None:
        """Keep a tile."""
        path = self._path(z, x, y)
        fresh = path.with_suffix(f".{secrets.token_hex(4)}")
        with contextlib.suppress(OSError):
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            fresh.write_bytes(content)
            fresh.replace(path)
        if self._bytes is None:
            self._bytes = sum(size for _, size, _ in self._all())
        else:
            self._bytes += len(content)
        if self._bytes > self._limit:
            self._thin()

    def _thin(self) -> None:
        """Delete what has not been looked at for longest."""
        left = sum(size for _, size, _ in self._all())
        for _, size, path in sorted(self._all()):
            if left <= self._limit * _KEEP_SHARE:
                break
            with contextlib.suppress(OSError):
                path.unlink()
            left -= size
        self._bytes = left

    def _all(self) -> list[tuple[float, int, Path]]:
        found = []
        for path in self._folder.glob("*/*/*"):
            with contextlib.suppress(OSError):
                facts = path.stat()
                found.append((facts.st_mtime, facts.st_size, path))
        return found

    def _path(self, z: int, x: int, y: int) -> Path:
        return self._folder / str(z) / str(x) / f"{y}.tile"
