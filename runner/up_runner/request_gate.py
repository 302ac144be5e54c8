"""Which requests are carried out: plain ones where permitted, and those under a key."""

from __future__ import annotations

from collections.abc import Mapping

from up.protocols.aircraft_sessions import Key
from up.system.addresses import is_private
from up_runner.config import Security
from up_runner.request import Request
from up_runner.response import Problem

UNPROTECTED = Problem(
    "unprotected", "this runner requires a key: pair this device ('up keys add', then its text)"
)
OFF = Problem("protection_off", "this runner takes no keys (runner.yml: security)")
_STARTERS = ("pilot", "admin")


class RequestGate:
    """`keys` are those of keys.yml; `accepts_plain`: a public peer may do without one."""

    def __init__(self, security: Security, *, accepts_plain: bool) -> None:
        self.keys: Mapping[bytes, Key] = {}
        self.is_off = security == "off"
        self._security: Security = security
        self._accepts_plain = accepts_plain

    def use(self, keys: Mapping[bytes, Key]) -> None:
        self.keys = keys

    @property
    def accepts_public(self) -> bool:
        """Return whether peers with public addresses may connect."""
        if self._security in ("auto", "require"):
            has_keys = not all(each.refusal for each in self.keys.values())
            return self._accepts_plain or has_keys
        return self._accepts_plain

    def requires_key(self, host: str) -> bool:
        if self._security == "auto":
            return not self._accepts_plain and not is_private(host)
        return self._security == "require"


def refusal_of(key: Key, request: Request) -> Problem | None:
    """Return why a request under a key is refused: its aircraft, or its role."""
    if request.body:
        return Problem("malformed_request", "a protected request cannot hold another one")
    if key.aircraft not in ("", request.aircraft):
        text = f"the key {key.name} is for {key.aircraft}, not for {request.aircraft}"
        return Problem("wrong_aircraft", text)
    if request.action == "spawn" and key.role not in _STARTERS:
        text = f"the key {key.name} is that of an {key.role}, who may not start an instance"
        return Problem("forbidden", text)
    return None
