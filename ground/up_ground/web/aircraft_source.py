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
    def summary(self) -> str: ...

    def start(self) -> None: ...

    async def stop(self) -> None: ...

    def past(self) -> Iterable[dict[str, Any]]: ...

    def frame(self) -> FrameMessage | None: ...

    def status(self, page: ClientSession) -> dict[str, Any]: ...

    def on_second(self) -> None: ...

    def on_control(self, page: ClientSession, action: str, to: int | None) -> None: ...

    def on_command(self, page: ClientSession, message: Reader) -> None: ...

    def on_replay(self, page: ClientSession, action: str, message: Reader) -> None: ...

    def on_away(self, page: ClientSession) -> None:
        """Handle the loss of a page's link; the page may return."""

    def on_gone(self, page: ClientSession) -> None:
        """Handle the final loss of a page."""


class Subscribers(Protocol):
    """The pages, as an aircraft sees them."""

    def send_latest(self, aircraft: str, kind: str, make: Make) -> None: ...

    def notify(self, aircraft: str, message: dict[str, Any]) -> None: ...

    def send_status(self, aircraft: str) -> None: ...

    def all(self) -> list[ClientSession]: ...

    def get(self, number: int) -> ClientSession | None: ...
