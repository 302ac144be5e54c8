"""Why a TLS connection failed: a code and one sentence."""

import ssl

from up.errors import UserError

UNKNOWN_CA = "tls_unknown_ca"
PEER_PLAIN = "tls_peer_plain"
TIMEOUT = "tls_timeout"
FAILED = "tls_failed"
CLOSED = "tls_closed"

_VERIFIED = {
    9: ("tls_not_yet_valid", "its certificate is not valid yet; check the clocks of both sides"),
    10: ("tls_expired", "its certificate has expired; 'up certificates renew' makes a new one"),
    12: ("tls_list_expired", "the list of revoked certificates has expired; renew makes a new one"),
    18: (UNKNOWN_CA, "its certificate is self-signed, not of our CA"),
    19: (UNKNOWN_CA, "its certificate is of another CA"),
    20: (UNKNOWN_CA, "its certificate is of another CA"),
    21: (UNKNOWN_CA, "its certificate is of another CA"),
    23: ("tls_revoked", "its certificate is revoked"),
    26: ("tls_wrong_purpose", "its certificate is not for this side of a connection"),
    62: ("tls_wrong_name", "its certificate does not name this host"),
    64: ("tls_wrong_name", "its certificate does not name this address"),
}
"""Results of OpenSSL's verification (X509_V_ERR_*)."""
_REASONS = (
    ("PEER_DID_NOT_RETURN_A_CERTIFICATE", "tls_no_certificate", "it presents no certificate"),
    ("WRONG_VERSION_NUMBER", PEER_PLAIN, "it does not speak TLS on this port"),
    ("HTTP_REQUEST", PEER_PLAIN, "it does not speak TLS on this port"),
    ("ALERT_PROTOCOL_VERSION", "tls_too_old", "it refuses TLS 1.2 or later"),
    ("UNSUPPORTED_PROTOCOL", "tls_too_old", "it does not speak TLS 1.2 or later"),
    ("VERSION_TOO_LOW", "tls_too_old", "it does not speak TLS 1.2 or later"),
    ("ALERT_CERTIFICATE_EXPIRED", "tls_expired", "it refuses our certificate: it has expired"),
    ("ALERT_CERTIFICATE_REVOKED", "tls_revoked", "it refuses our certificate: it is revoked"),
    ("ALERT_UNKNOWN_CA", UNKNOWN_CA, "it refuses our certificate: it is of another CA"),
    ("ALERT_CERTIFICATE_REQUIRED", "tls_no_certificate", "it requires a certificate"),
    ("ALERT_BAD_CERTIFICATE", "tls_refused", "it refuses our certificate"),
    ("ALERT_UNSUPPORTED_CERTIFICATE", "tls_refused", "it refuses our certificate"),
    ("ALERT_HANDSHAKE_FAILURE", "tls_refused", "it refuses our certificate or our TLS"),
)
"""Reasons of OpenSSL, by the end of their name."""


class TLSError(UserError):
    """A TLS connection that could not be made or was ended; ``code`` begins with ``tls_``."""


def fault_of(error: OSError) -> TLSError:
    """Return an error of ``ssl`` as a code and a sentence about the peer."""
    if isinstance(error, ssl.SSLCertVerificationError):
        found = _VERIFIED.get(error.verify_code)
        if found is not None:
            return TLSError(found[1], found[0])
        text = f"its certificate is not accepted: {error.verify_message}"
        return TLSError(text, "tls_unverified")
    if isinstance(error, ssl.SSLEOFError | ssl.SSLZeroReturnError | ConnectionError):
        return TLSError("it closed the connection during the TLS handshake", CLOSED)
    reason = getattr(error, "reason", None) or ""
    for end, code, text in _REASONS:
        if reason.endswith(end):
            return TLSError(text, code)
    return TLSError(f"TLS failed: {reason or error.strerror or error}", FAILED)
