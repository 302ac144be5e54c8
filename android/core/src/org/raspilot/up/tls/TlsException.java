package org.raspilot.up.tls;

import java.security.cert.CertificateException;

/** Why TLS is refused; the message is a sentence without its subject and full stop. */
public final class TlsException extends CertificateException {
    private static final long serialVersionUID = 1L;
    /**
     * Alerts by which a peer refuses, with our code and sentence. An engine tells them only in its
     * text: all providers use the names of RFC 8446 there.
     */
    private static final String[][] ALERTS = {
        {"certificate_required", "tls_no_certificate", "it requires a certificate"},
        {"certificate_expired", "tls_expired", "it refuses our certificate: it has expired"},
        {"certificate_revoked", "tls_revoked", "it refuses our certificate: it is revoked"},
        {"unknown_ca", "tls_unknown_ca", "it refuses our certificate: it is of another CA"},
        {"bad_certificate", "tls_refused", "it refuses our certificate"},
        {"unsupported_certificate", "tls_refused", "it refuses our certificate"},
        {"handshake_failure", "tls_refused", "it refuses our certificate or our TLS"},
        {"protocol_version", "tls_too_old", "it has no TLS 1.2 or later"},
    };

    /** A code of docs/security.md, "Codes". */
    public final String code;

    TlsException(String code, String sentence) {
        super(sentence);
        this.code = code;
    }

    static TlsException of(Exception fault) {
        if (fault instanceof TlsException) {
            return (TlsException) fault;
        }
        final String text = String.valueOf(fault.getMessage());
        for (String[] alert : ALERTS) {
            if (text.toLowerCase(java.util.Locale.ROOT).contains(alert[0])) {
                return new TlsException(alert[1], alert[2]);
            }
        }
        return new TlsException("tls_failed", "TLS failed: " + text);
    }
}
