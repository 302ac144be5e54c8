"""Errors of a cog that the user can fix."""

from __future__ import annotations


class CogError(Exception):
    """A cog cannot be installed, registered or removed; the text is one sentence."""
