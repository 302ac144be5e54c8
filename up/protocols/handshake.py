"""The handshake that opens a session between a ground device and the aircraft (docs/security.md).

A ground sends a hello with a fresh nonce; the aircraft answers with a nonce of its own, or refuses.
Both derive the keys of the session from the paired secret and both nonces.
"""

import struct
from dataclasses import fields
from typing import ClassVar

from up.protocols.binary_line import HANDSHAKE
from up.protocols.envelope import (
    MAC_BYTES,
    EnvelopeError,
    Stream,
    expand,
    extract,
    is_authentic,
    keyed,
    mac,
)
from up.quick_dataclass import dataclass

NONCE_BYTES = 16
ROLES = ("observer", "operator", "pilot", "admin")
REFUSALS = ("unknown_key", "revoked", "expired", "changed", "secrecy_required")
_SALT = b"up handshake 1"


@dataclass(frozen=True, slots=True)
class _Handshake:
    KIND: ClassVar[int]
    LABEL: ClassVar[bytes]
    FORM: ClassVar[struct.Struct]

    def _fields(self) -> tuple[object, ...]:
        return tuple(getattr(self, each.name) for each in fields(self))

    def encode(self, aircraft: bytes, secret: bytes) -> bytes:
        body = bytes((HANDSHAKE, self.KIND)) + self.FORM.pack(*self._fields())
        return body + _mac(self.LABEL, aircraft, secret, body)

    def check(self, body: bytes, aircraft: bytes, secret: bytes) -> None:
        """Raise EnvelopeError if this was decoded from a body of another secret or aircraft."""
        expected = _mac(self.LABEL, aircraft, secret, body[:-MAC_BYTES])
        if not is_authentic(body[-MAC_BYTES:], expected):
            raise EnvelopeError("forged")


@dataclass(frozen=True, slots=True)
class Hello(_Handshake):
    """Ground to aircraft."""

    KIND = 1
    LABEL = b"hello"
    FORM = struct.Struct(">8s16s")
    key_id: bytes
    nonce: bytes


@dataclass(frozen=True, slots=True)
class Answer(_Handshake):
    """Aircraft to ground: the session, and the key of the streams to all grounds.

    ``frame_counter`` and ``message_counter``: those of the streams now; ``clock_ms``: the clock
    that telemetry reports as ``system.clock_ms``; ``wrapped``: the streams' key under a pad.
    """

    KIND = 2
    LABEL = b"answer"
    FORM = struct.Struct(">8s16s16sBIIQQQ32s")
    key_id: bytes
    ground_nonce: bytes
    nonce: bytes
    role: int
    session: int
    broadcast: int
    frame_counter: int
    message_counter: int
    clock_ms: int
    wrapped: bytes


@dataclass(frozen=True, slots=True)
class Refusal(_Handshake):
    """Aircraft to ground: no session, or its end; without a MAC that counts if unknown_key."""

    KIND = 3
    LABEL = b"refusal"
    FORM = struct.Struct(">8s16sB")
    key_id: bytes
    ground_nonce: bytes
    reason: int

    @property
    def code(self) -> str:
        return REFUSALS[self.reason]


@dataclass(frozen=True, slots=True)
class SecrecyHello(Hello):
    """The hello of a ground that can encrypt, to an aircraft that requires it."""

    KIND = 4
    LABEL = b"secrecy hello"


@dataclass(frozen=True, slots=True)
class SecrecyAnswer(Answer):
    """The answer that opens a session whose streams are encrypted."""

    KIND = 5
    LABEL = b"secrecy answer"


_FORMS: dict[int, type[Hello | Answer | Refusal]] = {
    each.KIND: each for each in (Hello, Answer, Refusal, SecrecyHello, SecrecyAnswer)
}


def decode(body: bytes) -> Hello | Answer | Refusal:
    """Return the handshake in a body, not authenticated yet; raises EnvelopeError."""
    form = _FORMS.get(body[1]) if len(body) > 1 else None
    if form is None or len(body) != 2 + form.FORM.size + MAC_BYTES:
        raise EnvelopeError("malformed")
    found = form(*form.FORM.unpack_from(body, 2))
    if isinstance(found, Answer) and found.role >= len(ROLES):
        raise EnvelopeError("malformed")
    if isinstance(found, Refusal) and found.reason >= len(REFUSALS):
        raise EnvelopeError("malformed")
    return found


class SessionKeys:
    """The keys of one session: its two streams, and the pad for the streams' key.

    ``form`` is Stream or EncryptedStream.
    """

    def __init__(
        self,
        aircraft: bytes,
        key_id: bytes,
        secret: bytes,
        nonces: tuple[bytes, bytes],
        form: type[Stream] = Stream,
    ) -> None:
        self._form = form
        self._root = extract(b"".join(nonces), secret)
        self._aircraft = aircraft
        self._key_id = key_id

    def stream(self, direction: bytes, session: int) -> Stream:
        """Return the stream ``command`` to the aircraft or ``answer`` to the ground."""
        key = self._expand(direction, session)
        return self._form(key, direction, self._aircraft, self._key_id, session)

    def wrap(self, key: bytes, session: int, broadcast: int) -> bytes:
        """Return the key of the streams under this session's one-time pad, or back."""
        pad = self._expand(b"pad", session, broadcast)
        return bytes(each ^ other for each, other in zip(key, pad, strict=True))

    def _expand(self, label: bytes, *ids: int) -> bytes:
        numbers = (each.to_bytes(4, "big") for each in ids)
        return expand(self._root, label, self._aircraft, self._key_id, *numbers)


def broadcast_streams(
    key: bytes, aircraft: bytes, broadcast: int, form: type[Stream] = Stream
) -> tuple[Stream, Stream]:
    """Return the streams to all grounds: of telemetry, which may be skipped, and of messages."""
    return (
        form(key, b"telemetry", aircraft, b"", broadcast),
        form(key, b"message", aircraft, b"", broadcast + 1),
    )


def _mac(label: bytes, aircraft: bytes, secret: bytes, body: bytes) -> bytes:
    key = expand(extract(_SALT, secret), label, aircraft)
    return mac(keyed(key, label, aircraft), body)
