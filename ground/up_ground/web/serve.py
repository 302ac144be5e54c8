"""The options of ``up-ground serve``."""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import os
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from up.cli.cli_error import UsageError
from up.system.aircraft_name import AIRCRAFT_NAME
from up.tls.files import TLSFiles
from up_ground.catalogue import Catalogue
from up_ground.key_store import KeyStore, page_key
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore, state_folder
from up_ground.web.access import Access, machine_names
from up_ground.web.aircraft_session import AircraftSession
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.listen_address import ListenAddress, parse_listen
from up_ground.web.tile_cache import TileCache, cache_folder

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub
    from up_ground.web.tiles import TileSource

MakeTiles = Callable[[Any], "TileSource"]
AIRCRAFT_LIMIT = 64
_ONE = re.compile(
    rf"(?P<name>{AIRCRAFT_NAME.pattern})"
    r"(?:@(?P<host>\[[0-9A-Fa-f:.%a-z]+\]|[A-Za-z0-9_.%-]{1,255}):(?P<port>[0-9]{1,5})"
    r"(?P<direct>/direct)?)?",
    re.ASCII,
)


def parse_aircraft(text: str, usual: Settings) -> Settings:
    """Return the peer of ``NAME[@HOST:PORT[/direct]]``; raises UsageError.

    Without an address it is an aircraft of ``usual``'s proxy. Names must be unique: pages select
    an aircraft by its name.
    """
    match = _ONE.fullmatch(text)
    port = int(match["port"] or usual.port) if match else 0
    if match is None or not 1 <= port <= 65535:
        raise UsageError(
            f"{text!r} is not NAME[@HOST:PORT[/direct]], such as glider-1@192.168.1.5:50002/direct",
            "invalid_aircraft",
        )
    named = replace(usual, aircraft=match["name"], seat=Seat.LISTEN)
    host = match["host"]
    if host is None:
        return named
    return replace(named, host=host.strip("[]"), port=port, direct=bool(match["direct"]))


def fleet_of(options: argparse.Namespace) -> list[Settings]:
    """Return the aircraft to watch; raises UsageError."""
    usual = Settings(
        options.host, options.port, options.aircraft, Seat.LISTEN, options.direct, options.tls
    )
    store = KeyStore(state_folder(os.environ))
    usual_names = [] if options.paired else [options.aircraft]
    chosen = [parse_aircraft(text, usual) for text in options.fleet or usual_names]
    if options.paired:
        more = sorted(store.all().keys() - {each.aircraft for each in chosen})
        chosen += [replace(usual, aircraft=name) for name in more]
        if not chosen:
            raise UsageError("--paired: no key is stored; run 'up-ground pair'", "not_paired")
    chosen = [replace(each, pairing=store.get(each.aircraft)) for each in chosen]
    names = [each.aircraft for each in chosen]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"the aircraft {name} is given twice", "duplicate_aircraft")
    if len(chosen) > AIRCRAFT_LIMIT:
        raise UsageError(f"at most {AIRCRAFT_LIMIT} aircraft", "too_many_aircraft")
    return chosen


@dataclass(frozen=True, slots=True)
class PageOptions:
    """Where the page is served, the allowed clients, and the map."""

    listen: ListenAddress
    access: Access
    make_tiles: MakeTiles | None
    attribution: str
    https: TLSFiles | None = None
    key_place: str = ""
    """Where a user finds the key of the page; empty: none is needed."""

    @classmethod
    def of(cls, options: argparse.Namespace, environ: Mapping[str, str]) -> PageOptions:
        try:
            # Its further dependencies are an extra; every other verb starts without them.
            importlib.import_module("up_ground.web.server")
        except ModuleNotFoundError as error:
            raise UsageError(
                f"the page needs the Python package {error.name}, which is not installed:"
                " pip install 'raspilot[ground]'",
                "package_missing",
            ) from None
        try:
            listen = parse_listen(options.listen)
        except ValueError as error:
            raise UsageError(str(error), "invalid_listen") from None
        # On loopback a key is needed only if one is given.
        key, place = options.key, "the key of --key" if options.key else ""
        if key is None and not listen.is_loopback and not options.watch_only:
            key, place = page_key(state_folder(environ))
        place = "" if options.watch_only else place
        access = Access(machine_names(options.name or ()), key, options.watch_only)
        https = None if options.https is None else TLSFiles(options.https)
        if https is not None:
            https.server(clients=False)
        tiles = _tiles_of(options.tiles, environ)
        return cls(listen, access, tiles, options.attribution, https, place)

    def server(self, reactor: Any, make_sources: Any, **more: Any) -> Any:
        server = importlib.import_module("up_ground.web.server")
        tiles = None if self.make_tiles is None else self.make_tiles(reactor)
        return server.Server(
            reactor,
            self.listen,
            self.access,
            make_sources,
            tiles=tiles,
            attribution=self.attribution,
            https=self.https,
            key_place=self.key_place,
            **more,
        )


def _tiles_of(source: str, environ: Mapping[str, str]) -> MakeTiles | None:
    if not source:
        return None
    # Here, because its library takes long to load and most flights have no map.
    from up_ground.web.tiles import TileSource, source_fault

    fault = source_fault(source)
    if not fault and source.startswith("https:") and importlib.util.find_spec("OpenSSL") is None:
        fault = "https needs the Python package pyOpenSSL: pip install 'twisted[tls]'"
    if fault:
        raise UsageError(f"--tiles: {fault}", "invalid_tiles")
    cache = TileCache(cache_folder(environ), source)
    return lambda reactor: TileSource(reactor, source, cache)


def make_sessions(
    reactor: Any,
    chosen: Iterable[Settings],
    environ: Mapping[str, str],
    subscribers: ClientHub,
    catalogue: Catalogue,
) -> Iterable[AircraftSource]:
    """Yield an aircraft for each of the settings."""
    keys = KeyStore(state_folder(environ))
    for settings in chosen:
        tokens = TokenStore(state_folder(environ), settings)
        yield AircraftSession(
            reactor, settings.aircraft, settings, tokens, catalogue, subscribers, keys
        )
