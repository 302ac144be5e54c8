"""What a user can mend about a cog."""

from __future__ import annotations


class CogError(Exception):
    """A cog cannot be installed, registered or removed; the text is one sentence."""
