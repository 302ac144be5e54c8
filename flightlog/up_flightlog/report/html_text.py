"""Safe HTML: all text is escaped unless this module created it."""

from __future__ import annotations

import html

from up.fields import printable

_VOID = frozenset({"br", "img", "meta", "source"})


class Markup(str):
    """HTML from this module; every other string is text."""

    __slots__ = ()


def tag(name: str, /, *children: str | None, **attributes: str | int | None) -> Markup:
    """Return an element; a None among its children or attributes is left out.

    An attribute's name may end in ``_`` to avoid a Python keyword; an inner ``_`` becomes ``-``.
    """
    words = [name]
    for key, value in attributes.items():
        if value is not None:
            word = key.rstrip("_").replace("_", "-")
            words.append(f'{word}="{html.escape(str(value))}"')
    opened = f"<{' '.join(words)}>"
    if name in _VOID:
        return Markup(opened)
    return Markup(f"{opened}{join(*children)}</{name}>")


def join(*children: str | None) -> Markup:
    """Return the children joined."""
    return Markup("".join(map(markup, filter(None, children))))


def markup(text: str) -> Markup:
    """Return text as HTML; non-printable characters, line ends too, are shown escaped."""
    return text if isinstance(text, Markup) else Markup(html.escape(printable(text)))


def lines(text: str) -> Markup:
    """Return text with its lines and tabs kept, for <pre>."""
    return Markup("\n".join(markup(line.expandtabs(8)) for line in text.splitlines()))


def table(head: list[str], rows: list[list[str]], *, right: tuple[int, ...] = ()) -> Markup:
    """Return a table; the columns numbered in ``right`` hold numbers."""

    def cells(kind: str, row: list[str]) -> Markup:
        return join(
            *(
                tag(kind, cell, class_="number" if number in right else None)
                for number, cell in enumerate(row)
            )
        )

    return tag(
        "div",
        tag(
            "table",
            tag("thead", tag("tr", cells("th", head))) if any(head) else None,
            tag("tbody", *(tag("tr", cells("td", row)) for row in rows)),
        ),
        class_="table",
    )
