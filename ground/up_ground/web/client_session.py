"""A page with its rights and its Commands, over successive connections."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any
from typing import Protocol as Interface

from up_ground.web.messages import message_bytes
from up_ground.web.page_link import PageOutput


class PageConnection(Interface):
    """The WebSocket of a page."""

    output: PageOutput
    host: str
    """Its remote address."""

    def admit(self) -> None:
        """Apply the limits of a welcomed page from now on."""

    def close(self, code: int, reason: str) -> None:
        """Close it; ``code`` is 4000 to 4999, as RFC 6455 leaves them to us."""

    def is_alive(self, within_s: float, tell: Any) -> None:
        """Ping the page; ``tell`` gets whether the answer came in time."""


@dataclass(slots=True)
class Ask:
    """A Command requested by a page, and its answer when it has arrived."""

    content: str
    answer: dict[str, Any] | None = None


class Page:
    """A page with its name and its rights; ``link`` is None while it is disconnected.

    ``asks`` holds the Commands of its present link by the page's numbers.
    """

    def __init__(self, number: int, name: str, token: str, why_not: str) -> None:
        self.number = number
        self.name = name
        self.token = token
        self.why_not = why_not
        self.watched = ""
        self.link: PageConnection | None = None
        self.asks: dict[int, Ask] = {}

    @property
    def may_control(self) -> bool:
        """Return whether it may request control."""
        return not self.why_not

    def tell(self, message: dict[str, Any]) -> None:
        """Send a message in order; lost while the page is disconnected."""
        self.tell_bytes(message_bytes(message))

    def tell_bytes(self, message: bytes) -> None:
        """Send an encoded message."""
        if self.link is not None:
            self.link.output.send(message)

    def news(self, kind: str, make: Any) -> None:
        """Send a message that the next of its kind replaces."""
        if self.link is not None:
            self.link.output.send_newest(kind, make)

    def fault(self, text: str) -> None:
        """Report an error of the page to it."""
        self.tell({"type": "fault", "text": text})


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
