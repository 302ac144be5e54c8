"""Access rules: who may see the page, and which pages may control."""

from __future__ import annotations

import hmac
import re
import socket
from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import urlsplit

from up.system.addresses import neighbourhood, stays_here
from up.system.clock import Clock
from up.system.http_host import names_this_machine
from up.system.token_bucket import TokenBucket

_ORIGIN = re.compile(r"https?://([^/?#@\\]{1,300})", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Denial:
    """Why a page may not control."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class Access:
    """The rules of one server.

    ``names``: this machine's host names, in small letters. ``key``: required for control; None:
    no key. ``is_watch_only``: no page may control at all.
    """

    names: frozenset[str] = frozenset({"localhost"})
    key: str | None = None
    is_watch_only: bool = False

    def permits_host(self, host: str | None) -> bool:
        """Return whether a request's Host names this machine by an address or one of its names.

        A foreign page whose name resolves to this machine (DNS rebinding) sends another Host.
        """
        return names_this_machine(host, self.names)

    def permits_origin(self, origin: str | None, host: str | None) -> bool:
        """Return whether the page that opens a link is from here; a program sends no origin."""
        if origin is None:
            return True
        match = _ORIGIN.fullmatch(origin)
        return match is not None and host is not None and match[1].casefold() == host.casefold()

    def is_key(self, key: str) -> bool:
        given = key.encode("utf-8", "replace")
        return self.key is not None and hmac.compare_digest(given, self.key.encode())

    def denial(self, is_signed_in: bool) -> Denial | None:
        """Return why a page may not control; None if it may."""
        if self.is_watch_only:
            return Denial("watch_only", "this server was started with --watch-only")
        if self.key is None or is_signed_in:
            return None
        return Denial("no_key", "sign in with the key of this ground station")

    def permits_secrets(self, peer: str, origin: str | None, is_https: bool) -> bool:
        """Return whether nobody on a network reads what a page of ``origin`` sends.

        A page without HTTPS must be on this machine; so must be a web server that speaks HTTPS for
        this one.
        """
        page = urlsplit(origin or "http://localhost")
        is_here = page.scheme == "https" or stays_here(page.hostname or "")
        return is_https or (stays_here(peer) and is_here)


def machine_names(more: Iterable[str] = ()) -> frozenset[str]:
    """Return this machine's host names on its network, and the additional names."""
    own = socket.gethostname().casefold().rstrip(".")
    short = own.partition(".")[0]
    found = {"localhost", own, short, f"{short}.local", *(name.casefold() for name in more)}
    return frozenset(name for name in found if name and name != ".local")


MAX_ATTEMPTS = 10
ATTEMPTS_RATE_HZ = 0.1
ADDRESSES_KEPT = 1024


class KeyAttempts:
    """A bucket of wrong keys for each IPv4 address and each IPv6 /64 network.

    Right keys take nothing from it, so pages behind one address do not use up each other's. Of more
    than ``ADDRESSES_KEPT`` addresses the one that tried least recently is forgotten.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._known: dict[str, tuple[TokenBucket, float]] = {}

    def permits(self, host: str, is_right: bool) -> bool:
        """Count a key and return whether it is judged; False after too many wrong ones."""
        now_s, peer = self._clock.seconds(), neighbourhood(host)
        fresh = TokenBucket(self._clock, ATTEMPTS_RATE_HZ, MAX_ATTEMPTS), now_s
        bucket, closed_until_s = self._known.pop(peer, fresh)
        is_permitted = now_s >= closed_until_s if is_right else bucket.take()
        if not is_permitted and not is_right:
            closed_until_s = now_s + 1 / ATTEMPTS_RATE_HZ
        self._known[peer] = bucket, closed_until_s
        if len(self._known) > ADDRESSES_KEPT:
            del self._known[next(iter(self._known))]
        return is_permitted
