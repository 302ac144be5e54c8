"""The protected session on a link: hellos, renewal, and what the link's status shows of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from up.protocols.binary_line import HANDSHAKE, PROTECTED, SHORT, to_body, to_line
from up.protocols.encrypted_stream import is_available
from up.protocols.envelope import EnvelopeError
from up.protocols.ground_session import GroundSession
from up.protocols.handshake import ROLES, Answer, Refusal
from up.protocols.pairing import Pairing
from up.system.clock import Clock, Timer, cancel
from up_ground.link_status import LinkStatus

ANSWER_S = 2.0
"""An answer that takes longer is void: the relay may have held it back."""
RENEW_S = 60.0
"""Period of new sessions, which compare the clocks again."""
SLOW_S, AGAIN_S = 0.3, 5.0
"""After an answer that took longer the clocks are compared again soon."""
_RETRY_S = 1.0
"""Minimum time between hellos after an unknown stream."""


class LinkSecurity:
    """Keeps a session with the aircraft while the link is open."""

    def __init__(self, clock: Clock, pairing: Pairing, status: LinkStatus) -> None:
        self._clock = clock
        self._status = status
        status.is_keyed = True
        status.key_name = pairing.name
        self._session = GroundSession(
            pairing.aircraft, bytes.fromhex(pairing.key_id), bytes.fromhex(pairing.secret)
        )
        self._send: Callable[[bytes], Any] | None = None
        self._sent_s = float("-inf")
        self._timer: Timer | None = None

    def start(self, send: Callable[[bytes], Any]) -> None:
        self._send = send
        self._hello()

    def stop(self) -> None:
        """End with the connection; the session before is not resumed."""
        cancel(self._timer)
        self._send = None
        self._status.key_role = ""

    def seal(self, line: bytes) -> bytes | None:
        """Return the protected line of a line to the aircraft; None without a session."""
        if not self._status.key_role:
            return None
        return to_line(self._session.seal(line.removesuffix(b"\n")))

    def open(self, line: bytes) -> bytes | None:
        """Return the body of a line; None: it is a handshake, for others, or refused and counted.

        A plain line is refused: an attacker who can drop the protected ones could have written it.
        """
        try:
            body = to_body(line)
            if body[0] in (PROTECTED, SHORT):
                return self._session.open(body)
            if body[0] == HANDSHAKE:
                self._on_handshake(body)
            else:
                self._status.unprotected += 1
        except EnvelopeError as error:
            if error.code == "unknown_stream":
                # A new start of the aircraft, or a new key after a revocation.
                self.renew()
            else:
                self._status.refused += 1
        except ValueError:
            self._status.refused += 1
        return None

    def renew(self) -> None:
        """Ask for a new session, at most once a second."""
        if self._send is not None and self._clock.seconds() - self._sent_s >= _RETRY_S:
            self._hello()

    def _hello(self) -> None:
        assert self._send is not None
        self._sent_s = self._clock.seconds()
        self._send(to_line(self._session.hello()))
        self._schedule(ANSWER_S, self._on_no_answer)

    def _on_no_answer(self) -> None:
        self._session.forget_hello()
        self._hello()

    def _on_handshake(self, body: bytes) -> None:
        said = self._session.on_handshake(body)
        if isinstance(said, Answer):
            self._on_answer(said)
        elif isinstance(said, Refusal):
            self._status.key_role = ""
            was_secret, session = self._session.secrecy, self._session
            session.secrecy = said.code == "secrecy_required" and is_available()
            if session.secrecy and not was_secret:
                self._hello()
                return
            self._status.key_refusal = said.code
            self._session.forget_hello()
            self._schedule(RENEW_S if said.code == "revoked" else ANSWER_S, self._hello)

    def _on_answer(self, said: Answer) -> None:
        now_s = self._clock.seconds()
        status = self._status
        status.key_role, status.key_refusal = ROLES[said.role], ""
        status.is_secret = self._session.secrecy
        status.clock = (said.clock_ms, self._sent_s, now_s)
        is_slow = now_s - self._sent_s > SLOW_S
        self._schedule(AGAIN_S if is_slow else RENEW_S, self._hello)

    def _schedule(self, delay_s: float, call: Callable[[], object]) -> None:
        cancel(self._timer)
        self._timer = self._clock.callLater(delay_s, call)
