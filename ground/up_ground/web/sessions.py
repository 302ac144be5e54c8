"""Sessions: a page exchanges the key once for a random token, which its cookie carries."""

from __future__ import annotations

import hashlib
import secrets
from http import HTTPStatus

from up.errors import UserError
from up.system.clock import Clock
from up_ground.web.access import Access, KeyAttempts

MAX_SESSIONS = 32
"""Of more, the one that was not used for longest ends."""
UNUSED_S = 12 * 3600.0
"""A session that no open page uses ends after this time."""


class SignInError(UserError):
    """A refused key; ``status_code`` is that of the answer."""

    def __init__(self, text: str, code: str, status_code: int) -> None:
        super().__init__(text, code)
        self.status_code = status_code


class Sessions:
    """The sessions of one server, which end with it, by the hashes of their tokens."""

    def __init__(self, clock: Clock, access: Access) -> None:
        self._clock = clock
        self._access = access
        self._attempts = KeyAttempts(clock)
        self._used_s: dict[bytes, float] = {}

    def sign_in(self, host: str, key: str) -> str:
        """Return the token of a new session for the right key; raises SignInError."""
        if self._access.key is None or self._access.is_watch_only:
            text = "there is no key to sign in with"
            raise SignInError(text, "no_sign_in", HTTPStatus.NOT_FOUND)
        is_right = self._access.is_key(key)
        if not self._attempts.permits(host, is_right):
            text = "too many wrong keys from this address: try again in a minute"
            raise SignInError(text, "too_many_keys", HTTPStatus.TOO_MANY_REQUESTS)
        if not is_right:
            raise SignInError("this is not the key", "wrong_key", HTTPStatus.FORBIDDEN)
        token = secrets.token_urlsafe(32)
        self._used_s[_digest(token)] = self._clock.seconds()
        if len(self._used_s) > MAX_SESSIONS:
            del self._used_s[next(iter(self._used_s))]
        return token

    def use(self, token: str) -> bool:
        """Return whether a token is that of a session, whose time begins again."""
        digest, now_s = _digest(token), self._clock.seconds()
        used_s = self._used_s.pop(digest, None)
        if used_s is None or now_s - used_s > UNUSED_S:
            return False
        self._used_s[digest] = now_s
        return True

    def end(self, token: str) -> None:
        self._used_s.pop(_digest(token), None)


def _digest(token: str) -> bytes:
    return hashlib.sha256(token.encode("utf-8", "replace")).digest()


def cookie_name(port: int) -> str:
    """Return the cookie's name: browsers send a host's cookies to all of its ports."""
    return f"up_ground_{port}"


def token_of(cookies: str | None, port: int) -> str:
    """Return the token in a Cookie header; empty without one."""
    for part in (cookies or "").split(";"):
        name, _, value = part.strip().partition("=")
        if name == cookie_name(port):
            return value
    return ""
