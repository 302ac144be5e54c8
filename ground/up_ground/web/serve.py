"""``up-ground serve``: what its options mean."""

from __future__ import annotations

import argparse
import secrets
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from up_ground.catalogue import Catalogue
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore, state_folder
from up_ground.web.access import Access, machine_names
from up_ground.web.commands import Checks
from up_ground.web.fleet import AIRCRAFT_LIMIT, parse_aircraft
from up_ground.web.listen_address import ListenAddress, parse_listen
from up_ground.web.site import Tiles
from up_ground.web.station import Station
from up_ground.web.tile_cache import TileCache, cache_folder
from up_ground.web.watched import Audience, WatchedAircraft

MakeTiles = Callable[[Any], Tiles]


class ServeError(ValueError):
    """An option that cannot be; the text is one sentence."""


def fleet_of(options: argparse.Namespace) -> list[Settings]:
    """Return whom to watch; raises ServeError."""
    usual = Settings(options.host, options.port, options.aircraft, Seat.LISTEN, options.direct)
    try:
        chosen = [parse_aircraft(text, usual) for text in options.fleet or [options.aircraft]]
    except ValueError as error:
        raise ServeError(str(error)) from None
    names = [each.aircraft for each in chosen]
    for name in names:
        if names.count(name) > 1:
            raise ServeError(f"the aircraft {name} is given twice")
    if len(chosen) > AIRCRAFT_LIMIT:
        raise ServeError(f"at most {AIRCRAFT_LIMIT} aircraft")
    return chosen


def listen_of(options: argparse.Namespace) -> ListenAddress:
    """Return where to listen; raises ServeError."""
    try:
        return parse_listen(options.listen)
    except ValueError as error:
        raise ServeError(str(error)) from None


def tiles_of(options: argparse.Namespace, environ: Mapping[str, str]) -> MakeTiles | None:
    """Return what makes the source of the map's pictures; None: no map. Raises ServeError."""
    source = options.tiles
    if not source:
        return None
    # Here, because its library takes long to load and most flights have no map.
    from up_ground.web.tiles import TileSource, source_fault

    fault = source_fault(source)
    if fault:
        raise ServeError(f"--tiles: {fault}")
    cache = TileCache(cache_folder(environ), source)
    return lambda reactor: TileSource(reactor, source, cache)


def access_of(options: argparse.Namespace, listen: ListenAddress) -> Access:
    """Return who may what: on loopback nobody needs a key unless one is given."""
    key = options.key or (None if listen.is_loopback else secrets.token_urlsafe(12))
    return Access(machine_names(options.name or ()), key, options.watch_only)


def make_stations(
    reactor: Any, chosen: Iterable[Settings], environ: Mapping[str, str], audience: Audience
) -> Iterable[WatchedAircraft]:
    """Yield an aircraft for each of the settings."""
    checks = Checks(Catalogue.installed())
    for settings in chosen:
        tokens = TokenStore(state_folder(environ), settings)
        yield Station(reactor, settings.aircraft, settings, tokens, checks, audience)
