"""`up-ground foxglove` with a plain WebSocket in place of Foxglove's server.

``python -m bench.foxglove_peer AIRCRAFT_PORT PORT``: the same frames and places, as JSON texts.
"""

import os
import sys
from typing import Any

from autobahn.twisted.websocket import WebSocketServerFactory, WebSocketServerProtocol

from up_ground.foxglove_server import FoxgloveServer
from up_ground.one_shot_task import run
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore, state_folder
from up_ground.web.listen_address import ListenAddress, parse_listen


class Client(WebSocketServerProtocol):
    """A watching program."""

    def onOpen(self) -> None:  # noqa: N802 - the library's name
        self.factory.clients.add(self)

    def onClose(self, *_: object) -> None:  # noqa: N802 - the library's name
        self.factory.clients.discard(self)


class PlainSocket(WebSocketServerFactory):
    """Sends every message to all clients; in place of Foxglove's channels and its server."""

    noisy = False
    protocol = Client

    def __init__(self, reactor: Any) -> None:
        super().__init__(reactor=reactor)
        self.clients: set[Client] = set()

    def log(self, message: bytes, log_time: int) -> None:
        for client in self.clients:
            client.sendMessage(message)

    def publish_status(self, *_: object) -> None:
        """Drop it: a plain WebSocket has none."""

    remove_status = publish_status


class PlainServer(FoxgloveServer):
    """Differs in its output alone."""

    def __init__(
        self, reactor: Any, settings: Settings, tokens: TokenStore, listen: ListenAddress
    ) -> None:
        super().__init__(reactor, settings, tokens, listen)
        self._server = self._frames = self._places = PlainSocket(reactor)

    def start(self) -> None:
        self._reactor.listenTCP(self._listen.port, self._server, interface=self._listen.host)
        self.link.start()
        self._check()


def main() -> int:
    """Serve until interrupted."""
    aircraft_port, listen = int(sys.argv[1]), parse_listen(f"127.0.0.1:{sys.argv[2]}")
    settings = Settings("127.0.0.1", aircraft_port, seat=Seat.LISTEN, direct=True)
    tokens = TokenStore(state_folder(os.environ), settings)
    return run(lambda reactor: PlainServer(reactor, settings, tokens, listen))


if __name__ == "__main__":
    sys.exit(main())
