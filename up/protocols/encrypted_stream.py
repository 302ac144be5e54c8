"""Protected messages that no relay can read (docs/security.md, Secrecy).

AES-256-GCM of the package `cryptography`, which is imported only where secrecy is required.
"""

from typing import Any

from up.protocols.envelope import MAC_BYTES, EnvelopeError, Stream, expand, prefixed

_LABEL = b"secrecy"


def is_available() -> bool:
    """Return whether this installation can encrypt."""
    try:
        _cipher(bytes(32))
    except ImportError:
        return False
    return True


def _cipher(key: bytes) -> Any:
    from cryptography.hazmat.primitives.ciphers.aead import AESGCM

    return AESGCM(key)


class EncryptedStream(Stream):
    """A stream whose payloads are encrypted; the tag of the cipher stands in place of the MAC.

    The nonce of a message is its session and counter: a key has one stream, whose counter only
    rises, and is never used after a restart. Raises ImportError without `cryptography`.
    """

    def __init__(
        self, key: bytes, direction: bytes, aircraft: bytes, key_id: bytes, session: int
    ) -> None:
        super().__init__(key, direction, aircraft, key_id, session)
        context = (direction, aircraft, key_id)
        self._cipher = _cipher(expand(key, _LABEL, *context, session.to_bytes(4, "big")))
        self._context = prefixed(*context)

    def _protect(self, place: bytes, payload: bytes) -> bytes:
        sealed: bytes = self._cipher.encrypt(place, payload, self._context)
        return sealed[-MAC_BYTES:] + sealed[:-MAC_BYTES]

    def _unprotect(self, place: bytes, protected: bytes) -> bytes:
        from cryptography.exceptions import InvalidTag

        sealed = protected[MAC_BYTES:] + protected[:MAC_BYTES]
        try:
            payload: bytes = self._cipher.decrypt(place, sealed, self._context)
        except InvalidTag:
            raise EnvelopeError("forged") from None
        return payload
