"""Pictures of the map on disk: each is fetched once, and a flight without network has them."""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path
from threading import Lock

BYTES_LIMIT = 200_000_000
TILES_LIMIT = 50_000
"""Maximum number of tiles in the index in memory."""
_CHECK_BYTES = hashlib.sha256().digest_size

Tile = tuple[int, int, int]


def cache_folder(environ: Mapping[str, str]) -> Path:
    """Return where tiles are kept: ``$XDG_CACHE_HOME/up-ground/tiles``, or ``~/.cache``'s."""
    home = environ.get("XDG_CACHE_HOME", "")
    base = Path(home) if home.startswith("/") else Path.home() / ".cache"
    return base / "up-ground" / "tiles"


class TileCache:
    """Tiles of one source, bounded in number and size; write errors are ignored.

    A file is a checksum and the tile, so a tile half written at a power cut is detected. Every
    method may block on the disk, and may be called from any thread.
    """

    def __init__(
        self, folder: Path, source: str, limit: int = BYTES_LIMIT, tiles_limit: int = TILES_LIMIT
    ) -> None:
        self._folder = folder / hashlib.sha256(source.encode()).hexdigest()[:16]
        self._limit = limit
        self._tiles_limit = tiles_limit
        self._lock = Lock()
        # The sizes of the files, least recently used first; None: not read yet.
        self._sizes: OrderedDict[Tile, int] | None = None
        self._bytes = 0

    def get(self, z: int, x: int, y: int) -> bytes | None:
        path = self._path((z, x, y))
        try:
            stored = path.read_bytes()
        except OSError:
            return None
        check, content = stored[:_CHECK_BYTES], stored[_CHECK_BYTES:]
        if hashlib.sha256(content).digest() != check:
            return None
        with contextlib.suppress(OSError):
            # Used tiles stay longest, in the next run too.
            os.utime(path)
        with self._lock:
            if self._sizes is not None and (z, x, y) in self._sizes:
                self._sizes.move_to_end((z, x, y))
        return content

    def put(self, z: int, x: int, y: int, content: bytes) -> None:
        tile = (z, x, y)
        path = self._path(tile)
        fresh = path.with_suffix(f".{secrets.token_hex(4)}")
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            fresh.write_bytes(hashlib.sha256(content).digest() + content)
            fresh.replace(path)
        except OSError:
            with contextlib.suppress(OSError):
                fresh.unlink()
            return
        with self._lock:
            if self._sizes is None:
                self._sizes = self._look()
                self._bytes = sum(self._sizes.values())
            self._bytes -= self._sizes.pop(tile, 0)
            self._sizes[tile] = _CHECK_BYTES + len(content)
            self._bytes += self._sizes[tile]
            self._thin(self._sizes)

    def _thin(self, sizes: OrderedDict[Tile, int]) -> None:
        while sizes and (self._bytes > self._limit or len(sizes) > self._tiles_limit):
            tile, size = sizes.popitem(last=False)
            self._bytes -= size
            with contextlib.suppress(OSError):
                self._path(tile).unlink()

    def _look(self) -> OrderedDict[Tile, int]:
        """Return the cached tiles; deletes files that a power cut left incomplete."""
        found = []
        for path in self._folder.glob("*/*/*"):
            with contextlib.suppress(OSError, ValueError):
                if path.suffix != ".tile":
                    path.unlink()
                    continue
                tile = (int(path.parts[-3]), int(path.parts[-2]), int(path.stem))
                facts = path.stat()
                found.append((facts.st_mtime_ns, tile, facts.st_size))
        return OrderedDict((tile, size) for _, tile, size in sorted(found))

    def _path(self, tile: Tile) -> Path:
        z, x, y = tile
        return self._folder / str(z) / str(x) / f"{y}.tile"
