"""A cog's name, its errors, and the progress output of the utilities."""

from __future__ import annotations

from collections.abc import Callable


class CogError(Exception):
    """A cog cannot be installed, registered or removed; the text is one sentence."""


def package_name(label: str) -> str:
    """Return the Python package of a cog's label: ``android-cog`` is ``android_cog``.

    Raises CogError for an invalid package name.
    """
    name = label.strip().replace("-", "_")
    if not name.isidentifier():
        raise CogError(f'"{label}" is no name of a cog: a cog is called like its Python package')
    return name


Echo = Callable[[str], None]


def echo(text: str) -> None:
    """Show a line to the user."""
    print(text, flush=True)  # noqa: T201 - command line output
