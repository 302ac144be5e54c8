"""A package index on the loopback interface that records requests."""

from __future__ import annotations

import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from types import TracebackType
from typing import Any


class PackageIndex:
    """Serves ``folder/simple/<name>/`` pages made from the distributions that are added."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.asked: list[str] = []
        handler = partial(_Handler, self.asked, directory=str(folder))
        self._server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    def add(self, distribution: Path) -> None:
        """Offer a wheel or sdist under the name that its file has."""
        is_wheel = distribution.suffix == ".whl"
        stem = distribution.name.split("-")[0] if is_wheel else distribution.name.rsplit("-", 1)[0]
        name = stem.replace("_", "-").lower()
        page = self._folder / "simple" / name / "index.html"
        page.parent.mkdir(parents=True, exist_ok=True)
        (page.parent / distribution.name).write_bytes(distribution.read_bytes())
        links = (
            f'<a href="{each.name}">{each.name}</a>'
            for each in sorted(page.parent.iterdir())
            if each != page
        )
        page.write_text(f"<!DOCTYPE html><html><body>{''.join(links)}</body></html>")

    @property
    def environ(self) -> dict[str, str]:
        """Return what lets pip use this index and no other."""
        port = self._server.server_address[1]
        return {"PIP_NO_INDEX": "0", "PIP_INDEX_URL": f"http://127.0.0.1:{port}/simple/"}

    def __enter__(self) -> PackageIndex:
        """Begin to serve."""
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Stop serving."""
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()


class _Handler(SimpleHTTPRequestHandler):
    def __init__(self, asked: list[str], *args: Any, **kwargs: Any) -> None:
        self._asked = asked
        super().__init__(*args, **kwargs)

    def log_message(self, format: str, *args: Any) -> None:
        self._asked.append(self.path)
