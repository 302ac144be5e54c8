"""The web server of recorded flights, on the loopback interface only."""

from __future__ import annotations

from typing import Any

from twisted.internet.error import CannotListenError

from up.cli.option_parser import EXIT_OK
from up_ground.one_shot_task import EXIT_NO_ANSWER, OneShotTask
from up_ground.view.log_resource import LogResource, ShownFlight
from up_ground.web.access import Access
from up_ground.web.connections import Connections
from up_ground.web.site import make_site
from up_ground.web.static_files import STATIC, StaticFiles

LOOPBACK = "127.0.0.1"


class LogServer(OneShotTask):
    """Serves until it is interrupted."""

    def __init__(self, reactor: Any, port: int, flights: list[ShownFlight]) -> None:
        super().__init__()
        self._reactor = reactor
        self._port_number = port
        resource = LogResource(Access(), StaticFiles(STATIC), flights)
        self._factory = Connections(reactor, make_site(reactor, resource))
        self._port: Any = None

    def start(self) -> None:
        """Open the port and print the page's address."""
        try:
            self._port = self._reactor.listenTCP(
                self._port_number, self._factory, interface=LOOPBACK
            )
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            text = f"cannot open {LOOPBACK}:{error.port}: {reason} (--port selects another)"
            self.fail(text, "listen_failed", EXIT_NO_ANSWER)
            return
        url = f"http://{LOOPBACK}:{self._port.getHost().port}/"
        self.echo(f"open {url}", "page_open", url=url)
        self.echo("Ctrl-C ends it", "ready")

    def finish(self, status: int) -> None:
        """End; an interrupt is how a server ends."""
        super().finish(EXIT_OK if self._port is not None else status)

    async def stop(self) -> None:
        if self._port is not None:
            await self._port.stopListening()
