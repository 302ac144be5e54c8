"""Any text as the content of an XML element."""

from __future__ import annotations

import re
from xml.sax.saxutils import escape

# XML 1.0, 2.2: the permitted characters; the rest cannot even be written as a reference.
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml_text(text: str) -> str:
    """Return the text with markup escaped and every character that XML forbids replaced."""
    return escape(_FORBIDDEN.sub("\ufffd", text).replace("\r", "\n"))
