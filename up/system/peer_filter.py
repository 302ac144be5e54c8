"""Decides which peers may use the plain, unauthenticated protocol."""

from twisted.logger import Logger

from up.system.addresses import is_private, is_wildcard

_LOGGED_LIMIT = 20


class PeerFilter:
    """Checks the addresses of a plain listener: public ones are refused unless accepted.

    A listener on a wildcard address checks each peer on arrival. ``key`` is the configuration key
    that accepts public peers, for the messages. ``refused`` counts peers.
    """

    log = Logger()

    def __init__(self, accepts_public: bool, key: str) -> None:
        self.refused = 0
        self._accepts_public = accepts_public
        self._key = key
        self._logged: set[str] = set()

    def refusal_of(self, address: str) -> str:
        """Return why listening on ``address`` is forbidden, one sentence; empty if permitted."""
        try:
            if self._accepts_public or is_wildcard(address) or is_private(address):
                return ""
        except ValueError:
            return f"{address!r} is not a literal IP address"
        return (
            f"{address} is public and this listener does not authenticate peers; use a private"
            f" address, or accept it with {self._key}: true"
        )

    def permits(self, host: str) -> bool:
        """Return whether a peer with this literal address may connect; count and log a refused one.

        Refuses anything that is not a literal address.
        """
        try:
            if self._accepts_public or is_private(host):
                return True
        except ValueError:
            pass
        self.refused += 1
        if host not in self._logged and len(self._logged) < _LOGGED_LIMIT:
            self._logged.add(host)
            self.log.warn(
                "refused the public address {host} on a plain listener ({key}); logged once",
                host=host,
                key=self._key,
                code="peer_refused",
            )
        return False
