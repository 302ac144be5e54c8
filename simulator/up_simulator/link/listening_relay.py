"""Common to every link between real sockets: its listening address and its target."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from twisted.internet.error import CannotListenError


class LinkRelayError(Exception):
    """The relay cannot listen: the message is one sentence for the user."""


class ListeningRelay(ABC):
    """Listens on a local port for traffic to a target.

    Port 0 is any free port; ``port`` has it after ``start``.
    """

    def __init__(
        self, reactor: Any, listen_port: int, target: tuple[str, int], interface: str
    ) -> None:
        self._reactor = reactor
        self._interface = interface
        self._target = target
        self._listen_port = listen_port
        self._listener: Any = None

    @property
    def port(self) -> int:
        """Return where it listens."""
        return self._listen_port if self._listener is None else self._listener.getHost().port

    def start(self) -> int:
        """Listen and return the port; raises ``LinkRelayError``."""
        try:
            self._listener = self._listen()
        except CannotListenError as error:
            raise LinkRelayError(
                f"the link cannot listen on {self._interface}:{self._listen_port}: "
                f"{error.socketError}"
            ) from error
        return self.port

    @abstractmethod
    def _listen(self) -> Any:
        """Return the listening port; raises ``CannotListenError``."""
