"""What a user of ``up`` can mend."""

from __future__ import annotations


class CliError(Exception):
    """A verb cannot do what was asked; the text is one sentence for the user."""
