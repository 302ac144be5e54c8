"""The origin of a logged Command, as the flight log writes it."""

from functools import lru_cache

from up.commands.origin import INTERNAL, Origin

KEY = "_origin"
"""The key beside a Command's own fields."""


def origin_text(origin: Origin) -> str:
    """Return ``ground (pilot)``: link and role; ``internal`` for a module's own Commands.

    ``ground/tablet (pilot)`` for a Command that the key ``tablet`` protects.
    """
    if origin.link == INTERNAL.link:
        return INTERNAL.link
    key = f"/{origin.key}" if origin.key else ""
    return f"{origin.link}{key} ({origin.role.value})"


def link_and_role(text: object) -> tuple[str, str]:
    """Return the link and role in `origin_text`'s result; two empty texts for anything else."""
    return _link_and_role(text) if isinstance(text, str) else ("", "")


@lru_cache(maxsize=64)
def _link_and_role(text: str) -> tuple[str, str]:
    if text == INTERNAL.link:
        return text, INTERNAL.role.value
    link, _, role = text.partition(" (")
    return (link, role[:-1]) if role.endswith(")") else (text, "")
