"""The site of the documentation below ``/docs/``, kept apart from the page of the same server.

`make docs` writes it into the static files, and `make dist` into the wheel. Its scripts are allowed
by their hashes, and run in a separate origin (``sandbox``): with neither cookie nor link nor
storage of the page, whatever a link to a search of the site contains.
"""

from __future__ import annotations

import base64
import hashlib
import re
from pathlib import Path
from typing import Any

from up_ground.web.static_files import StaticFile

DOCS = b"/docs/"
_POLICY = (
    b"default-src 'none'; script-src 'self'%s; style-src 'self' 'unsafe-inline';"
    b" img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none';"
    b" frame-ancestors 'none'; sandbox allow-scripts"
)
_INLINE = re.compile(rb"<script>(.*?)</script>", re.DOTALL)


def has_documentation(static: Path) -> bool:
    """Return whether the static files have the site."""
    return (static / "docs" / "index.html").is_file()


def allow_scripts(request: Any, file: StaticFile | None) -> None:
    """Replace the page's headers by those of the site."""
    inline = [] if file is None else _INLINE.findall(file.content)
    hashes = b"".join(
        b" 'sha256-%s'" % base64.b64encode(hashlib.sha256(each).digest()) for each in inline
    )
    request.setHeader(b"content-security-policy", _POLICY % hashes)
    # Its own files are of another origin for it, which the server's link and session refuse. A
    # browser refuses a sandbox with the page's opener policy.
    request.setHeader(b"access-control-allow-origin", b"null")
    request.setHeader(b"cross-origin-resource-policy", b"cross-origin")
    request.setHeader(b"cross-origin-opener-policy", b"unsafe-none")
