"""Protected messages: who sent a body, to whom, and in which order (docs/security.md).

Standard parts only: HMAC-SHA256 cut to 16 bytes, and HKDF-SHA256 (RFC 5869) for the keys.
"""

import hmac
import struct

from up.protocols.binary_line import PROTECTED, SHORT

SECRET_BYTES = 32
MAC_BYTES = 16
_PLACE = struct.Struct(">IQ")
_MAC_AT = 1 + _PLACE.size
_BODY_AT = _MAC_AT + MAC_BYTES
HEADER_BYTES = _BODY_AT - 1
"""Session, counter and MAC, between the type byte and the payload."""
_SHORT_AT = _MAC_AT - 1
"""A short body has of session and counter only the counter's last byte."""
BROADCAST = 1 << 31
"""Set in the ids of streams to all grounds, clear in those of sessions."""


class EnvelopeError(ValueError):
    """A refused protected message or handshake; `code` is the reason."""

    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code


def prefixed(*parts: bytes) -> bytes:
    """Return the parts, each after its length in 4 bytes: no two lists give the same bytes."""
    return b"".join([len(part).to_bytes(4, "big") + part for part in parts])


def extract(salt: bytes, secret: bytes) -> bytes:
    """Return HKDF-Extract of a secret."""
    return hmac.digest(salt, secret, "sha256")


def expand(key: bytes, *context: bytes) -> bytes:
    """Return HKDF-Expand for a context: one block, 32 bytes."""
    return hmac.digest(key, prefixed(*context) + b"\x01", "sha256")


def keyed(key: bytes, *context: bytes) -> hmac.HMAC:
    """Return a MAC that has read its context, to be copied for each message."""
    return hmac.new(key, prefixed(*context), "sha256")


def mac(state: hmac.HMAC, *parts: bytes) -> bytes:
    """Return the MAC of the parts after the state's context."""
    state = state.copy()
    state.update(prefixed(*parts))
    return state.digest()[:MAC_BYTES]


def is_authentic(found: bytes, expected: bytes) -> bool:
    """Compare two MACs in constant time."""
    return hmac.compare_digest(found, expected)


def is_newer(counter: int, newest: int) -> bool:
    """Return whether a counter has not been used: counters only rise."""
    return counter > newest


def place_of(body: bytes) -> tuple[int, int]:
    """Return session and counter of a protected body; raises EnvelopeError for another body."""
    if len(body) < _BODY_AT or body[0] != PROTECTED:
        raise EnvelopeError("malformed")
    session, counter = _PLACE.unpack_from(body, 1)
    return session, counter


def shortened(body: bytes) -> bytes:
    """Return the short form of a protected body, for a reader that knows its stream."""
    return bytes((SHORT,)) + body[_SHORT_AT:]


class Stream:
    """One direction of one session: its sender seals bodies, its receiver opens them.

    ``counter`` is that of the newest message that was sealed or opened.
    """

    def __init__(
        self, key: bytes, direction: bytes, aircraft: bytes, key_id: bytes, session: int
    ) -> None:
        self.session = session
        self.counter = 0
        self._state = keyed(key, direction, aircraft, key_id)

    def seal(self, payload: bytes) -> bytes:
        """Return the protected body of the next message."""
        self.counter += 1
        place = _PLACE.pack(self.session, self.counter)
        return bytes((PROTECTED,)) + place + self._protect(place, payload)

    def restored(self, body: bytes) -> bytes:
        """Return the protected body of a short one: the next one whose counter ends so.

        A body that was taken before, or that 256 others preceded unread, is then forged.
        """
        next_ = self.counter + 1
        counter = next_ + (body[1] - next_) % 256 if len(body) > 1 else 0
        return bytes((PROTECTED,)) + _PLACE.pack(self.session, counter) + body[2:]

    def open(self, body: bytes) -> bytes:
        """Return the payload; raises EnvelopeError: malformed, forged or replayed."""
        _, counter = place_of(body)
        payload = self._unprotect(body[1:_MAC_AT], body[_MAC_AT:])
        if not is_newer(counter, self.counter):
            raise EnvelopeError("replayed")
        self.counter = counter
        return payload

    def _protect(self, place: bytes, payload: bytes) -> bytes:
        return self._mac(place, payload) + payload

    def _unprotect(self, place: bytes, protected: bytes) -> bytes:
        """Return the payload behind its MAC; raises EnvelopeError: forged."""
        payload = protected[MAC_BYTES:]
        if not is_authentic(protected[:MAC_BYTES], self._mac(place, payload)):
            raise EnvelopeError("forged")
        return payload

    def _mac(self, place: bytes, payload: bytes) -> bytes:
        return mac(self._state, place[:4], place[4:], payload)
