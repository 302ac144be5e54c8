"""The aircraft's end of protected links: its keys, its sessions, its streams to all grounds."""

import secrets
from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Any

from up.protocols import handshake
from up.protocols.attitude_frame import is_attitude
from up.protocols.encrypted_stream import EncryptedStream
from up.protocols.envelope import (
    BROADCAST,
    SECRET_BYTES,
    EnvelopeError,
    Stream,
    place_of,
    shortened,
)
from up.protocols.handshake import (
    NONCE_BYTES,
    ROLES,
    Answer,
    Hello,
    Refusal,
    SecrecyAnswer,
    SecrecyHello,
    SessionKeys,
)
from up.protocols.handshake import broadcast_streams as streams_of
from up.quick_dataclass import dataclass

SESSIONS_PER_KEY = 32
"""Of those in which a Command came, and of the others, so that repeated hellos end only these."""
IDLE_MS = 150_000
"""A session that is neither used nor renewed ends: a ground renews it each minute."""
_MAX_ID = BROADCAST - 2


@dataclass(frozen=True, slots=True)
class Key:
    """A paired device; ``refusal`` is one of handshake.REFUSALS, or empty for a valid key.

    ``aircraft``: the one that the key is for; empty: every one that has the key.
    """

    id: bytes
    secret: bytes = field(repr=False)
    name: str
    role: str
    refusal: str = ""
    aircraft: str = ""


class Session:
    """One ground device; ``owner`` is the caller's own object."""

    def __init__(self, key: Key, hello: Hello, keys: SessionKeys, number: int, now_ms: int) -> None:
        self.key = key
        self.number = number
        self.used_ms = now_ms
        self.owner: Any = None
        self.hello = hello
        self.commands = keys.stream(b"command", number)
        self.answers = keys.stream(b"answer", number)

    @property
    def is_confirmed(self) -> bool:
        """Return whether the ground has proved that it has the session's keys."""
        return self.commands.counter > 0


class AircraftSessions:
    """Answers hellos, opens the grounds' messages, seals those to them.

    ``clock_ms`` is the clock that telemetry reports. Nothing here survives a restart: the ids of
    sessions and streams are drawn at random, their keys come from fresh nonces. With ``secrecy``
    all sessions are encrypted.
    """

    def __init__(
        self,
        aircraft: str,
        clock_ms: Callable[[], int],
        random: Callable[[int], bytes] = secrets.token_bytes,
        secrecy: bool = False,
    ) -> None:
        self._secrecy = secrecy
        self._form = EncryptedStream if secrecy else Stream
        self._aircraft = aircraft.encode()
        self._clock_ms = clock_ms
        self._random = random
        self._keys: Mapping[bytes, Key] = {}
        self._sessions: dict[int, Session] = {}
        self._draw_streams()

    def __len__(self) -> int:
        return len(self._sessions)

    def name_of(self, refusal: Refusal) -> str:
        """Return the name of the key that was refused; empty for an unknown one."""
        key = self._keys.get(refusal.key_id)
        return "" if key is None else key.name

    def replace_keys(
        self, keys: Mapping[bytes, Key]
    ) -> list[tuple[Session, tuple[Refusal, bytes]]]:
        """Use these keys; return each ended session and the refusal for its ground.

        A session ends if its key has changed in any way. Then the streams get a new key, which
        the ended sessions do not have; the others fetch it with a new hello.
        """
        self._keys = keys
        ended = [each for each in self._sessions.values() if keys.get(each.key.id) != each.key]
        for session in ended:
            del self._sessions[session.number]
        if ended:
            self._draw_streams()
        return [(each, self._end(each)) for each in ended]

    def answer(self, body: bytes) -> tuple[Session | Refusal, bytes]:
        """Return the session that a hello opens, or why there is none, and the reply.

        Raises EnvelopeError for a body that is not an authentic hello and gets no reply.
        """
        hello = handshake.decode(body)
        if not isinstance(hello, Hello):
            raise EnvelopeError("malformed")
        key = self._keys.get(hello.key_id)
        if key is None:
            # Without a secret: the ground may believe it or not.
            return self._refuse(hello, bytes(SECRET_BYTES), "unknown_key")
        hello.check(body, self._aircraft, key.secret)
        if key.refusal:
            return self._refuse(hello, key.secret, key.refusal)
        if isinstance(hello, SecrecyHello) is not self._secrecy:
            code = "secrecy_required" if self._secrecy else "changed"
            return self._refuse(hello, key.secret, code)
        nonce = self._random(NONCE_BYTES)
        keys = SessionKeys(self._aircraft, key.id, key.secret, (hello.nonce, nonce), self._form)
        session = Session(key, hello, keys, self._draw_number(), self._clock_ms())
        self._sessions[session.number] = session
        self._make_room(session)
        reply = (SecrecyAnswer if self._secrecy else Answer)(
            key.id,
            hello.nonce,
            nonce,
            ROLES.index(key.role),
            session.number,
            self._frames.session,
            self._frames.counter,
            self._messages.counter,
            self._clock_ms(),
            keys.wrap(self._stream_key, session.number, self._frames.session),
        )
        return session, reply.encode(self._aircraft, key.secret)

    def open(self, body: bytes) -> tuple[Session, bytes]:
        """Return the sender and payload of a protected body; raises EnvelopeError."""
        session = self._sessions.get(place_of(body)[0])
        if session is None:
            raise EnvelopeError("unknown_session")
        was_confirmed = session.is_confirmed
        payload = session.commands.open(body)
        session.used_ms = self._clock_ms()
        if not was_confirmed:
            self._make_room(session)
        return session, payload

    def end_idle(self) -> None:
        """End the sessions of grounds that have gone."""
        oldest_ms = self._clock_ms() - IDLE_MS
        for session in list(self._sessions.values()):
            if session.used_ms < oldest_ms:
                del self._sessions[session.number]

    def seal_frame(self, payload: bytes) -> bytes:
        """Return the protected body of telemetry, for all grounds; short for an attitude frame."""
        body = self._frames.seal(payload)
        return shortened(body) if is_attitude(payload) else body

    def seal_message(self, payload: bytes) -> bytes:
        """Return the protected body of another message, for all grounds."""
        return self._messages.seal(payload)

    def _draw_streams(self) -> None:
        self._stream_key = self._random(SECRET_BYTES)
        number = BROADCAST | int.from_bytes(self._random(4), "big") & ~1
        self._frames, self._messages = streams_of(
            self._stream_key, self._aircraft, number, self._form
        )

    def _draw_number(self) -> int:
        while True:
            number = int.from_bytes(self._random(4), "big") % _MAX_ID + 1
            if number not in self._sessions:
                return number

    def _make_room(self, newest: Session) -> None:
        """End the least recently used session beside a new one that is beyond the limit."""
        others = [
            each
            for each in self._sessions.values()
            if each is not newest
            and each.key.id == newest.key.id
            and each.is_confirmed is newest.is_confirmed
        ]
        if len(others) >= SESSIONS_PER_KEY:
            del self._sessions[min(others, key=lambda each: each.used_ms).number]

    def _end(self, session: Session) -> tuple[Refusal, bytes]:
        key = self._keys.get(session.key.id)
        code = "unknown_key" if key is None else key.refusal or "changed"
        return self._refuse(session.hello, session.key.secret, code)

    def _refuse(self, hello: Hello, secret: bytes, code: str) -> tuple[Refusal, bytes]:
        refusal = Refusal(hello.key_id, hello.nonce, handshake.REFUSALS.index(code))
        return refusal, refusal.encode(self._aircraft, secret)
