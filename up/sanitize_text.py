"""Texts from the air, made harmless for a terminal."""

import unicodedata

_WIDE = ("W", "F")


def sanitize_text(text: object, limit: int = 200) -> str:
    """Return a value as text of at most ``limit`` characters, each one column wide.

    Control characters, escape sequences, marks that combine, letters that change the direction of
    writing and double-width letters are written as ``\\x1b`` or ``\\u202e``.
    """
    given = str(text) if not isinstance(text, str) else text
    shown = "".join(
        c if _is_plain(c) else c.encode("unicode_escape").decode("ascii") for c in given[:limit]
    )
    return shown if len(shown) <= limit else shown[: max(0, limit - 1)] + "~"


def _is_plain(character: str) -> bool:
    if character.isascii():
        return character.isprintable()
    return (
        character.isprintable()
        and unicodedata.category(character)[0] not in "MC"
        and unicodedata.east_asian_width(character) not in _WIDE
    )
