"""The interface between pages and the aircraft that they watch."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Protocol

from up.protocols.link_output import Make
from up_ground.web.client_session import ClientSession
from up_ground.web.messages import FrameMessage, Reader


class AircraftSource(Protocol):
    """An aircraft as the server knows it: a real one, or a flight of the past."""

    name: str

    @property
    def summary(self) -> str:
        """Return the aircraft in one line."""

    def start(self) -> None:
        """Begin."""

    async def stop(self) -> None:
        """End."""

    def past(self) -> Iterable[dict[str, Any]]:
        """Return the messages for a page that starts to watch."""

    def frame(self) -> FrameMessage | None:
        """Return the newest frame."""

    def status(self, page: ClientSession) -> dict[str, Any]:
        """Return the status as this page sees it."""

    def on_second(self) -> None:
        """Handle the end of a second."""

    def on_control(self, page: ClientSession, action: str, to: int | None) -> None:
        """Let a page request, give, deny or release control."""

    def on_command(self, page: ClientSession, message: Reader) -> None:
        """Send a page's Command."""

    def on_replay(self, page: ClientSession, action: str, message: Reader) -> None:
        """Let a page control the replay."""

    def on_away(self, page: ClientSession) -> None:
        """Handle the loss of a page's link; the page may return."""

    def on_gone(self, page: ClientSession) -> None:
        """Handle the final loss of a page."""


class Subscribers(Protocol):
    """The pages, as an aircraft sees them."""

    def send_latest(self, aircraft: str, kind: str, make: Make) -> None:
        """Send the pages that watch the aircraft a message that the next of its kind replaces."""

    def notify(self, aircraft: str, message: dict[str, Any]) -> None:
        """Send a message to the pages that watch the aircraft."""

    def send_status(self, aircraft: str) -> None:
        """Give the aircraft's status to every page."""

    def all(self) -> list[ClientSession]:
        """Return the pages that are here."""

    def get(self, number: int) -> ClientSession | None:
        """Return the page with that number that is here."""
