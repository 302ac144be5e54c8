"""A page with its rights and its Commands, over successive connections; the messages to it."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from up.protocols.link_output import BaseOutput, Make
from up_ground.web.access import Denial

if TYPE_CHECKING:
    from up_ground.web.page_link import PageLink

PENDING_LIMIT = 1 << 20
"""Bytes in order that wait for a page that does not read; more, and it is given up."""
_ENCODER = json.JSONEncoder(allow_nan=False, separators=(",", ":"))
_FINAL_TEXT = 0x81


def text_frame(payload: bytes) -> bytes:
    """Return the one frame of a text message, unmasked as a server's are; ``payload`` is UTF-8.

    Made here so that one message is encoded once for all pages, and so that unsent messages can
    still be replaced.
    """
    size = len(payload)
    if size < 126:
        return bytes((_FINAL_TEXT, size)) + payload
    if size < 65536:
        return struct.pack(">BBH", _FINAL_TEXT, 126, size) + payload
    return struct.pack(">BBQ", _FINAL_TEXT, 127, size) + payload


def message_bytes(fields: Mapping[str, Any]) -> bytes:
    """Return a message as one text frame."""
    return text_frame(_ENCODER.encode(fields).encode("ascii"))


class AgedMessage:
    """A message with its age at the time of sending, encoded to JSON once for all pages.

    ``age_s`` returns its age at a time ``now_s`` of the monotonic clock.
    """

    __slots__ = ("_age_s", "_body", "_now_s")

    def __init__(
        self,
        fields: Mapping[str, Any],
        age_s: Callable[[float], float],
        now_s: Callable[[], float],
    ) -> None:
        self._body = _ENCODER.encode(fields)[:-1].encode("ascii") + b',"age_ms":'
        self._age_s = age_s
        self._now_s = now_s

    def __call__(self) -> bytes:
        now_s = self._now_s()
        age_ms, sent_ms = self._age_s(now_s) * 1000, now_s * 1000
        return text_frame(b'%b%.1f,"sent_ms":%.1f}' % (self._body, age_ms, sent_ms))


class FrameMessage(AgedMessage):
    """A frame of telemetry; ``time_s``: its time in a recorded flight."""

    __slots__ = ()

    def __init__(
        self,
        aircraft: str,
        beacon: int | None,
        data: Mapping[str, Any],
        age_s: Callable[[float], float],
        now_s: Callable[[], float],
        time_s: float | None = None,
    ) -> None:
        fields: dict[str, Any] = {
            "type": "frame",
            "aircraft": aircraft,
            "beacon": beacon,
            "data": data,
        }
        if time_s is not None:
            fields["time_s"] = round(time_s, 3)
        super().__init__(fields, age_s, now_s)


class PageSendBuffer(BaseOutput):
    """The send buffer of a WebSocket.

    A frame or a status is encoded when it is sent, not when it arrives, so that its age is right.
    ``on_overrun`` is called when ``PENDING_LIMIT`` is exceeded; after that nothing is sent.
    """

    def __init__(self, on_overrun: Callable[[], object]) -> None:
        super().__init__()
        self._on_overrun = on_overrun

    def send(self, message: bytes) -> None:
        if self._transport is None:
            return
        self._put(message)
        if self._size > PENDING_LIMIT:
            self.stopProducing()
            self._on_overrun()

    def send_newest(self, kind: str, make: Make) -> None:
        """Send the result of ``make`` in place of a queued one of this kind."""
        if self._transport is not None:
            self._put_news(kind, make, may_leave=self._is_drained)

    def discard(self, kind: str) -> None:
        self._news.pop(kind, None)


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
        self.session = ""
        """The token of the session in which it signed in; empty: it has none."""
        self.link: PageLink | None = None
        self.asks: dict[int, Ask] = {}

    @property
    def may_control(self) -> bool:
        return self.denial is None

    def send(self, message: dict[str, Any]) -> None:
        self.send_bytes(message_bytes(message))

    def send_bytes(self, message: bytes) -> None:
        if self.link is not None:
            self.link.output.send(message)

    def send_latest(self, kind: str, make: Make) -> None:
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
