"""An aircraft as the server knows it: a real one, or a flight of the past."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Any

from up.protocols.pairing import Pairing
from up_ground.web.client_session import ClientSession, FrameMessage
from up_ground.web.messages import PageFault, Reader


class AircraftSource(ABC):
    """What `ClientHub` calls; pages watch it by its name."""

    name: str
    newest_frame: FrameMessage | None = None

    @property
    @abstractmethod
    def summary(self) -> str: ...

    @abstractmethod
    def start(self) -> None: ...

    @abstractmethod
    async def stop(self) -> None: ...

    @abstractmethod
    def past(self) -> Iterable[dict[str, Any]]:
        """Return the messages for a page that starts to watch."""

    @abstractmethod
    def status(self, page: ClientSession) -> dict[str, Any]: ...

    def row(self, now_s: float) -> dict[str, Any]:
        return {"name": self.name}

    @abstractmethod
    def on_control(self, page: ClientSession, action: str, to: int | None) -> None: ...

    @abstractmethod
    def on_command(self, page: ClientSession, message: Reader) -> None: ...

    @abstractmethod
    def on_replay(self, page: ClientSession, action: str, message: Reader) -> None: ...

    def on_plan(self, page: ClientSession, kind: str, message: Reader) -> None:
        """Begin an upload or a download; only a real aircraft has plans."""
        raise PageFault("this is a replay", "replay")

    async def pair(self, page: ClientSession, pairing: Pairing) -> None:
        """Keep a key for the aircraft and use it; raises PageFault, UserError and OSError."""
        raise PageFault("this is a replay", "replay")

    def on_second(self) -> None:  # noqa: B027 - a replay has nothing to do
        """Measure the link, once a second."""

    def on_away(self, page: ClientSession) -> None:  # noqa: B027
        """Handle the loss of a page's link; the page may return."""

    def on_gone(self, page: ClientSession) -> None:  # noqa: B027
        """Handle the final loss of a page."""
