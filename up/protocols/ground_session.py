"""The end of a protected link in a ground device."""

import secrets
from collections.abc import Callable

from up.protocols import handshake
from up.protocols.binary_line import SHORT
from up.protocols.encrypted_stream import EncryptedStream
from up.protocols.envelope import BROADCAST, SECRET_BYTES, EnvelopeError, Stream, place_of
from up.protocols.handshake import (
    NONCE_BYTES,
    Answer,
    Hello,
    Refusal,
    SecrecyAnswer,
    SecrecyHello,
    SessionKeys,
)
from up.protocols.handshake import broadcast_streams as streams_of

_SHORT = bytes((SHORT,))


class GroundSession:
    """Sends hellos, checks answers, seals Commands, opens what the aircraft sends.

    A new session replaces the old one only when it is answered; answers on the one before are
    still accepted. ``secrecy``: the next hello asks for an encrypted session, and only the answer
    that opens one is taken.
    """

    def __init__(
        self,
        aircraft: str,
        key_id: bytes,
        secret: bytes,
        random: Callable[[int], bytes] = secrets.token_bytes,
    ) -> None:
        self._aircraft = aircraft.encode()
        self._key_id = key_id
        self._secret = secret
        self._random = random
        self.secrecy = False
        self._nonce = b""
        self._last_nonce = b""
        self._commands: Stream | None = None
        self._frames: Stream | None = None
        self._streams: dict[int, Stream] = {}

    @property
    def is_open(self) -> bool:
        return self._commands is not None

    def hello(self) -> bytes:
        """Return the body of a hello with a fresh nonce; an answer to an earlier one is void."""
        self._nonce = self._random(NONCE_BYTES)
        form = SecrecyHello if self.secrecy else Hello
        return form(self._key_id, self._nonce).encode(self._aircraft, self._secret)

    def forget_hello(self) -> None:
        """Refuse every answer to the last hello."""
        self._nonce = b""

    def on_handshake(self, body: bytes) -> Answer | Refusal | None:
        """Take an answer or refusal; None: it is for another ground. Raises EnvelopeError."""
        said = handshake.decode(body)
        if isinstance(said, Hello):
            raise EnvelopeError("malformed")
        if said.key_id != self._key_id:
            return None
        if isinstance(said, Refusal):
            return said if self._is_refused(said, body) else None
        if not self._nonce or said.ground_nonce != self._nonce:
            # To another program with this key, or to an earlier hello.
            return None
        said.check(body, self._aircraft, self._secret)
        if isinstance(said, SecrecyAnswer) is not self.secrecy:
            raise EnvelopeError("malformed")
        self._open(said)
        return said

    def seal(self, payload: bytes) -> bytes:
        """Return the protected body of a message to the aircraft; needs an open session."""
        assert self._commands is not None
        return self._commands.seal(payload)

    def open(self, body: bytes) -> bytes | None:
        """Return the payload of a protected body; None: it is for another ground.

        Raises EnvelopeError; `unknown_stream`: the aircraft has restarted or has drawn a new key.
        """
        if body[:1] == _SHORT:
            if self._frames is None:
                raise EnvelopeError("unknown_stream")
            return self._frames.open(self._frames.restored(body))
        number, _ = place_of(body)
        stream = self._streams.get(number)
        if stream is not None:
            return stream.open(body)
        if number & BROADCAST:
            raise EnvelopeError("unknown_stream")
        return None

    def _is_refused(self, said: Refusal, body: bytes) -> bool:
        if said.ground_nonce not in (self._nonce, self._last_nonce):
            return False
        # An aircraft that does not know the key cannot prove it; it ends no open session.
        if said.code == "unknown_key" and not self.is_open:
            return True
        said.check(body, self._aircraft, self._secret)
        self._commands = self._frames = None
        self._streams.clear()
        return True

    def _open(self, said: Answer) -> None:
        nonces = (said.ground_nonce, said.nonce)
        form = EncryptedStream if self.secrecy else Stream
        keys = SessionKeys(self._aircraft, self._key_id, self._secret, nonces, form)
        answers = keys.stream(b"answer", said.session)
        stream_key = keys.wrap(said.wrapped, said.session, said.broadcast)
        assert len(stream_key) == SECRET_BYTES
        frames, messages = streams_of(stream_key, self._aircraft, said.broadcast, form)
        # Messages from before the hello are not live, and none is taken twice.
        for stream, counter in ((frames, said.frame_counter), (messages, said.message_counter)):
            known = self._streams.get(stream.session)
            stream.counter = max(counter, known.counter if known else 0)
        before = [each for each in self._streams.values() if not each.session & BROADCAST][-1:]
        self._streams = {each.session: each for each in (*before, answers, frames, messages)}
        self._commands, self._frames = keys.stream(b"command", said.session), frames
        self._last_nonce, self._nonce = self._nonce, b""
