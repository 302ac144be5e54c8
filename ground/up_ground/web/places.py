"""Admission control: the number of pages, and which one leaves for a page with a reserved place."""

from __future__ import annotations

from collections.abc import Collection

from up_ground.web.page import Page

PAGES_LIMIT = 16
WATCHERS_LIMIT = 12
"""Pages that may not control leave places for those that may."""


class NoPlaceError(Exception):
    """No place for another page; the text is the close reason."""


def make_place(pages: Collection[Page], may_control: bool, watchers_limit: int) -> Page | None:
    """Return the page that must leave for a new one; None if there is a free place.

    ``pages`` are connected or reserved; reserved ones keep their places. Raises NoPlaceError.
    """
    watchers = [page for page in pages if not page.may_control]
    is_full = len(pages) >= PAGES_LIMIT
    if not may_control:
        if is_full or len(watchers) >= watchers_limit:
            raise NoPlaceError("too many pages are open")
        return None
    if not is_full:
        return None
    if not watchers:
        raise NoPlaceError("too many pages are open")
    return max(watchers, key=lambda page: page.number)
