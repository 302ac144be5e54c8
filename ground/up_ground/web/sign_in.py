"""``/session``: POST with the key signs in, DELETE signs out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from twisted.web import http

from up_ground.web.sessions import SignInError, cookie_name, token_of
from up_ground.web.site import only, refuse

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub

COOKIE_S = 7 * 86400
"""The browser keeps the cookie over a restart; how long it is valid is decided by the server."""


class SignIn:
    """Answers requests of the server's own page; the key is in a header, never in an address."""

    def __init__(self, pages: ClientHub, is_https: bool) -> None:
        self._pages = pages
        self._is_https = is_https

    def render(self, request: Any) -> bytes:
        if request.method == b"POST":
            return self._sign_in(request)
        if request.method == b"DELETE":
            self._pages.sign_out(token_of(only(request, b"cookie"), request.getHost().port))
            return self._answer(request, "", 0)
        request.setHeader(b"allow", b"POST, DELETE")
        return refuse(request, http.NOT_ALLOWED, "only POST and DELETE")

    def _sign_in(self, request: Any) -> bytes:
        key = (only(request, b"authorization") or "").removeprefix("Bearer ")
        try:
            token = self._pages.sessions.sign_in(request.getClientAddress().host, key)
        except SignInError as error:
            return refuse(request, error.status_code, str(error))
        return self._answer(request, token, COOKIE_S)

    def _answer(self, request: Any, token: str, max_age_s: int) -> bytes:
        # A web server in front may speak HTTPS for this one.
        is_https = self._is_https or (only(request, b"origin") or "").startswith("https:")
        request.addCookie(
            cookie_name(request.getHost().port),
            token,
            path="/",
            max_age=str(max_age_s),
            secure=is_https,
            httpOnly=True,
            sameSite="strict",
        )
        request.setResponseCode(http.NO_CONTENT)
        return b""
