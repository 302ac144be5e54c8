"""The ground station in a browser: a web server with a link to each aircraft."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twisted.internet.error import CannotListenError

from up.cli.option_parser import EXIT_OK
from up.system.figures import text_of
from up.system.metrics_page import serve_metrics
from up.system.notify import Notifier, WatchdogPinger
from up.tls.files import TLSFiles
from up.tls.protocol import TLSServerFactory
from up_ground.catalogue import Catalogue, catalogue_message
from up_ground.one_shot_task import EXIT_NO_ANSWER, OneShotTask
from up_ground.web.access import Access
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.client_hub import ClientHub
from up_ground.web.connections import Connections
from up_ground.web.documentation import has_documentation
from up_ground.web.listen_address import ListenAddress, authority
from up_ground.web.metrics import figures_of
from up_ground.web.page_link import link_resource
from up_ground.web.sign_in import SignIn
from up_ground.web.site import GroundResource, make_site
from up_ground.web.static_files import STATIC, StaticFiles

if TYPE_CHECKING:
    from up_ground.web.tiles import TileSource

MakeSources = Callable[[ClientHub], Iterable[AircraftSource]]


class Server(OneShotTask):
    """Serves until it is interrupted; an aircraft or a proxy that is not there is waited for."""

    def __init__(
        self,
        reactor: Any,
        listen: ListenAddress,
        access: Access,
        make_sources: MakeSources,
        *,
        tiles: TileSource | None = None,
        attribution: str = "",
        catalogue: Catalogue | None = None,
        is_replay: bool = False,
        folder: Path = STATIC,
        https: TLSFiles | None = None,
        key_place: str = "",
        metrics_port: int | None = None,
    ) -> None:
        super().__init__()
        told = None
        if tiles is not None:
            told = {"url": "/tiles/{z}/{x}/{y}", "attribution": attribution}
        # Without Commands there is nothing to offer.
        offered = None if catalogue is None else catalogue_message(catalogue)
        self.pages = ClientHub(
            reactor,
            access,
            tiles=told,
            catalogue=offered,
            is_replay=is_replay,
            has_docs=has_documentation(folder),
        )
        for aircraft in make_sources(self.pages):
            self.pages.fleet[aircraft.name] = aircraft
        self._reactor = reactor
        self._listen = listen
        self._tiles = tiles
        self._is_https = https is not None
        self._key_place = key_place
        link = link_resource(reactor, self.pages, self._is_https)
        sign_in = SignIn(self.pages, self._is_https)
        resource = GroundResource(access, StaticFiles(folder), link, tiles, sign_in)
        self._factory: Any = Connections(reactor, make_site(reactor, resource))
        if https is not None:
            self._factory = TLSServerFactory(reactor, https, self._factory, clients=False)
        self._port: Any = None
        self._metrics_port = metrics_port
        self._metrics: Any = None
        self._notifier = Notifier.from_environment()
        # A ping shows that the event loop turns, which is all that the server needs.
        self._pinger = WatchdogPinger(reactor, lambda: True, self._notifier)

    def start(self) -> None:
        """Open the port, print the page's address, and begin to connect."""
        listen = self._listen
        try:
            if self._metrics_port is not None:
                self._metrics = serve_metrics(
                    self._reactor, self._metrics_port, self._figures, lambda: ""
                )
            self._port = self._reactor.listenTCP(listen.port, self._factory, interface=listen.host)
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            address = authority(error.interface or "0.0.0.0", error.port)
            options = "--listen ADDRESS:PORT and --metrics PORT select others"
            text = f"cannot open {address}: {reason} ({options})"
            self.fail(text, "listen_failed", EXIT_NO_ANSWER, address=address)
            return
        scheme = "https" if self._is_https else "http"
        urls = listen.urls(self._port.getHost().port, scheme)
        self._print_addresses(urls)
        self.pages.start()
        for aircraft in self.pages.fleet.values():
            aircraft.start()
        self._notifier.ready(f"open {urls[0]}")
        self._pinger.start()

    def finish(self, status: int) -> None:
        """End; an interrupt is how a server ends."""
        super().finish(EXIT_OK if self._port is not None else status)

    async def stop(self) -> None:
        """Close the port, the pages' links and the aircraft's."""
        port, self._port = self._port, None
        self._pinger.stop()
        self._notifier.stopping()
        if self._metrics is not None:
            await self._metrics.stopListening()
        if port is None:
            return
        await self.pages.stop()
        if self._tiles is not None:
            self._tiles.stop()
        for aircraft in self.pages.fleet.values():
            await aircraft.stop()
        await port.stopListening()

    def _figures(self) -> str:
        return text_of(figures_of(self.pages))

    def _print_addresses(self, urls: Sequence[str]) -> None:
        for aircraft in self.pages.fleet.values():
            self.echo(f"  {aircraft.summary}", "aircraft", name=aircraft.name)
        self.echo(f"open {urls[0]}", "page_open", url=urls[0])
        for url in urls[1:]:
            self.echo(f"  or {url}", "page_address", url=url)
        if self._metrics is not None:
            url = f"http://127.0.0.1:{self._metrics.getHost().port}/metrics"
            self.echo(f"metrics: {url}", "metrics_open", url=url)
        if self._key_place:
            text = f"a page signs in with {self._key_place}; without it a page only watches"
            self.echo(text, "page_key")
        if not self._is_https and not self._listen.is_loopback:
            text = "not encrypted: others on the network may read the key; --https DIR protects it"
            self.echo(text, "page_plain")
        self.echo("Ctrl-C ends it", "ready")
