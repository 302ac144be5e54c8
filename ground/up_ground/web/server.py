"""The ground station in a browser: a web server with a link to each aircraft."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from twisted.internet.error import CannotListenError

from up.log.user_line import user_line
from up_ground.catalogue import Catalogue
from up_ground.errand import EXIT_DONE, EXIT_NO_ANSWER, Errand, Say
from up_ground.web.access import Access
from up_ground.web.catalogue_message import catalogue_message
from up_ground.web.connections import Connections
from up_ground.web.listen_address import ListenAddress, authority
from up_ground.web.page_link import link_resource
from up_ground.web.pages import Pages
from up_ground.web.site import GroundResource, Tiles, make_site
from up_ground.web.static_files import StaticFiles
from up_ground.web.watched import Audience, WatchedAircraft

STATIC = Path(__file__).with_name("static")

MakeFleet = Callable[[Audience], Iterable[WatchedAircraft]]


class Server(Errand):
    """Serves until it is interrupted; an aircraft or a proxy that is not there is waited for."""

    def __init__(
        self,
        reactor: Any,
        listen: ListenAddress,
        access: Access,
        make_fleet: MakeFleet,
        *,
        say: Say,
        complain: Say,
        tiles: Tiles | None = None,
        attribution: str = "",
        catalogue: Catalogue | None = None,
        is_replay: bool = False,
        folder: Path = STATIC,
    ) -> None:
        super().__init__(say, complain)
        told = None
        if tiles is not None:
            told = {"url": "/tiles/{z}/{x}/{y}", "attribution": attribution}
        # Without Commands there is nothing to offer.
        offered = None if catalogue is None else catalogue_message(catalogue)
        self.pages = Pages(reactor, access, tiles=told, catalogue=offered, is_replay=is_replay)
        for aircraft in make_fleet(self.pages):
            self.pages.fleet[aircraft.name] = aircraft
        self._reactor = reactor
        self._listen = listen
        self._access = access
        self._tiles = tiles
        link = link_resource(reactor, self.pages)
        files = StaticFiles(folder)
        resource = GroundResource(access, files, link, tiles)
        self._factory = Connections(reactor, make_site(reactor, resource))
        self._port: Any = None

    def start(self) -> None:
        """Open the port, print the page's address, and begin to connect."""
        listen = self._listen
        try:
            self._port = self._reactor.listenTCP(listen.port, self._factory, interface=listen.host)
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            self.complain(
                f"{authority(listen.host or '0.0.0.0', listen.port)} cannot be opened: {reason}"
                " (--listen ADDRESS:PORT names another)"
            )
            self.finish(EXIT_NO_ANSWER)
            return
        for line in self._words(self._port.getHost().port):
            self.say(line)
        self.pages.start()
        for aircraft in self.pages.fleet.values():
            aircraft.start()

    def finish(self, status: int) -> None:
        """End; an interrupt is how a server ends."""
        super().finish(EXIT_DONE if self._port is not None else status)

    async def stop(self) -> None:
        """Close the port, the pages' links and the aircraft's."""
        port, self._port = self._port, None
        if port is None:
            return
        await self.pages.stop()
        if self._tiles is not None:
            self._tiles.stop()
        for aircraft in self.pages.fleet.values():
            await aircraft.stop()
        await port.stopListening()

    def _words(self, port: int) -> Iterable[str]:
        for aircraft in self.pages.fleet.values():
            yield f"  {aircraft.summary}"
        key = None if self._access.is_watch_only else self._access.key
        urls = self._listen.urls(port, key)
        yield user_line(f"open {urls[0]}", "up_ground", code="page_open", url=urls[0])
        yield from (f"  or {url}" for url in urls[1:])
        if key:
            yield "the part after # lets a page control; without it a page only watches"
        yield "Ctrl-C ends it"
