"""The page's files, as they lie in the folder ``static``."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote_to_bytes

STATIC = Path(__file__).with_name("static")
MAX_FILE_BYTES = 8_000_000
_SEGMENT = re.compile(rb"[A-Za-z0-9_@-][A-Za-z0-9_.@-]{0,99}")
_PAGES = {
    b"/": b"/index.html",
    b"/overlay": b"/overlay.html",
    b"/docs/": b"/docs/index.html",
}
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".map": "application/json",
    ".webmanifest": "application/manifest+json",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".ico": "image/x-icon",
    ".woff2": "font/woff2",
    ".txt": "text/plain; charset=utf-8",
    ".md": "text/plain; charset=utf-8",
}


@dataclass(frozen=True, slots=True)
class StaticFile:
    """A file's bytes, its media type, and a tag that is another one as soon as it changes."""

    content: bytes
    media_type: str
    etag: str


class StaticFiles:
    """Serves files below ``folder`` only; a folder is not a file and is never listed."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()

    def get(self, path: bytes) -> StaticFile | None:
        """Return the file of a request's path, such as ``/js/main.js``; None if it is missing."""
        path = _PAGES.get(path, path)
        segments = unquote_to_bytes(path).split(b"/")
        if segments[0] or len(segments) > 8:
            return None
        if not all(_SEGMENT.fullmatch(segment) for segment in segments[1:]):
            return None
        place = self._folder.joinpath(*(each.decode("ascii") for each in segments[1:]))
        media_type = _TYPES.get(place.suffix)
        if media_type is None:
            return None
        try:
            # A link that leads out of the folder is not followed.
            place = place.resolve(strict=True)
            place.relative_to(self._folder)
            return self._read(place, media_type) if place.is_file() else None
        except (OSError, ValueError):
            return None

    def _read(self, place: Path, media_type: str) -> StaticFile | None:
        if place.stat().st_size > MAX_FILE_BYTES:
            return None
        content = place.read_bytes()
        return StaticFile(content, media_type, f'"{hashlib.sha256(content).hexdigest()[:24]}"')
