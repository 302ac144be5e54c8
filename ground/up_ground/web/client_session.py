"""A page with its rights and its Commands, over successive connections."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from up_ground.web.access import Denial
from up_ground.web.messages import message_bytes

if TYPE_CHECKING:
    from up_ground.web.page_link import PageLink


@dataclass(slots=True)
class Ask:
    """A Command requested by a page, and its answer when it has arrived."""

    content: str
    answer: dict[str, Any] | None = None


class ClientSession:
    """A page with its name and its rights; ``link`` is None while it is disconnected.

    ``asks`` holds the Commands of its present link by the page's numbers.
    """

    def __init__(self, number: int, name: str, token: str, denial: Denial | None) -> None:
        self.number = number
        self.name = name
        self.token = token
        self.denial = denial
        self.watched = ""
        self.link: PageLink | None = None
        self.asks: dict[int, Ask] = {}

    @property
    def may_control(self) -> bool:
        return self.denial is None

    def send(self, message: dict[str, Any]) -> None:
        """Send a message in order; lost while the page is disconnected."""
        self.send_bytes(message_bytes(message))

    def send_bytes(self, message: bytes) -> None:
        if self.link is not None:
            self.link.output.send(message)

    def send_latest(self, kind: str, make: Any) -> None:
        """Send a message that the next of its kind replaces."""
        if self.link is not None:
            self.link.output.send_newest(kind, make)

    def fault(self, text: str, code: str) -> None:
        self.send({"type": "fault", "code": code, "text": text})


PAGES_LIMIT = 16
WATCHERS_LIMIT = 12
"""Pages that may not control leave places for those that may."""


class AdmissionError(Exception):
    """No place for another page; the text is the close reason."""


def admit_page(
    pages: Collection[ClientSession], may_control: bool, watchers_limit: int
) -> ClientSession | None:
    """Return the page that must leave for a new one; None if there is a free place.

    ``pages`` are connected or reserved; reserved ones keep their places. Raises AdmissionError.
    """
    watchers = [page for page in pages if not page.may_control]
    is_full = len(pages) >= PAGES_LIMIT
    if not may_control:
        if is_full or len(watchers) >= watchers_limit:
            raise AdmissionError("too many pages are open")
        return None
    if not is_full:
        return None
    if not watchers:
        raise AdmissionError("too many pages are open")
    return max(watchers, key=lambda page: page.number)
