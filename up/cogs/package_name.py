"""The package name of a cog."""

from __future__ import annotations

from up.cogs.cog_error import CogError


def package_name(label: str) -> str:
    """Return the Python package of a cog's label: ``android-cog`` is ``android_cog``.

    Raises CogError for an invalid package name.
    """
    name = label.strip().replace("-", "_")
    if not name.isidentifier():
        raise CogError(f'"{label}" is no name of a cog: a cog is called like its Python package')
    return name
