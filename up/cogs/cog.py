"""A cog's name and its errors."""

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
            name=label,
        )
    return name
