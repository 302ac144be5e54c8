"""A cog's name, its errors, and the progress output of the utilities."""

from __future__ import annotations

from collections.abc import Callable

from up.errors import UserError


class CogError(UserError):
    """A cog cannot be installed, registered or removed; the text is one sentence."""


def package_name(label: str) -> str:
    """Return the Python package of a cog's label: ``radio-cog`` is ``radio_cog``.

    Raises CogError for an invalid package name.
    """
    name = label.strip().replace("-", "_")
    if not name.isidentifier():
        raise CogError(
            f'"{label}" is not the name of a cog, which is that of its Python package',
            code="name_invalid",
        )
    return name


Echo = Callable[[str], None]


def echo(text: str) -> None:
    """Show a line to the user."""
    print(text, flush=True)  # noqa: T201 - command line output
