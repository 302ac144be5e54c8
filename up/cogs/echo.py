"""Progress output of the utilities: one line each."""

from __future__ import annotations

from collections.abc import Callable

Echo = Callable[[str], None]


def echo(text: str) -> None:
    """Show a line to the user."""
    print(text, flush=True)  # noqa: T201 - command line output
