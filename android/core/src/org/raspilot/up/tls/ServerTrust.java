package org.raspilot.up.tls;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.security.cert.CertificateException;
import java.security.cert.CertificateExpiredException;
import java.security.cert.CertificateNotYetValidException;
import java.security.cert.CertificateParsingException;
import java.security.cert.X509CRL;
import java.security.cert.X509Certificate;
import java.util.Collection;
import java.util.Date;
import java.util.List;
import java.util.Locale;
import javax.net.ssl.X509TrustManager;

/**
 * Accepts the certificate of one server: of our CA, for servers, not revoked, with the name.
 *
 * <p>The name is checked here and not by the engine, which can do so from Android 7 on.
 */
final class ServerTrust implements X509TrustManager {
    private static final String FOR_SERVERS = "1.3.6.1.5.5.7.3.1";
    private static final int DNS_NAME = 2;
    private static final int ADDRESS = 7;

    private final X509TrustManager authorities;
    private final List<X509CRL> revoked;
    private final String host;
    private volatile TlsException fault;

    ServerTrust(X509TrustManager authorities, List<X509CRL> revoked, String host) {
        this.authorities = authorities;
        this.revoked = revoked;
        this.host = host;
    }

    /** Returns why the server was refused; null: it was not. May be called on any thread. */
    TlsException fault() {
        return fault;
    }

    @Override
    public void checkServerTrusted(X509Certificate[] chain, String type) throws TlsException {
        try {
            check(chain, type);
        } catch (TlsException found) {
            // Not every engine keeps the exception that it was given.
            fault = found;
            throw found;
        }
    }

    @Override
    public void checkClientTrusted(X509Certificate[] chain, String type) throws TlsException {
        throw new TlsException("tls_failed", "this certificate is not a server's");
    }

    @Override
    public X509Certificate[] getAcceptedIssuers() {
        return authorities.getAcceptedIssuers();
    }

    private void check(X509Certificate[] chain, String type) throws TlsException {
        final X509Certificate server = chain[0];
        try {
            final List<String> purposes = server.getExtendedKeyUsage();
            if (purposes != null && !purposes.contains(FOR_SERVERS)) {
                throw new TlsException("tls_wrong_purpose", "its certificate is not a server's");
            }
            authorities.checkServerTrusted(chain, type);
            if (!isNamed(server.getSubjectAlternativeNames(), host)) {
                throw new TlsException("tls_wrong_name", "its certificate does not name " + host);
            }
        } catch (TlsException found) {
            throw found;
        } catch (CertificateException refusal) {
            throw untrusted(refusal);
        }
        for (X509CRL list : revoked) {
            if (list.getNextUpdate() != null && list.getNextUpdate().before(new Date())) {
                throw new TlsException("tls_list_expired",
                        "the list of revoked certificates has expired");
            }
            if (list.isRevoked(server)) {
                throw new TlsException("tls_revoked", "its certificate is revoked");
            }
        }
    }

    private static TlsException untrusted(Throwable refusal) {
        for (Throwable each = refusal; each != null; each = each.getCause()) {
            if (each instanceof CertificateExpiredException) {
                return new TlsException("tls_expired", "its certificate has expired");
            }
            if (each instanceof CertificateNotYetValidException) {
                return new TlsException("tls_not_yet_valid",
                        "its certificate is not valid yet: check the clocks of both sides");
            }
        }
        return new TlsException("tls_unknown_ca", "its certificate is not of our CA");
    }

    /** Returns whether alternative names, null: none, have a name or address. */
    static boolean isNamed(Collection<List<?>> names, String host)
            throws CertificateParsingException {
        if (names != null) {
            for (List<?> each : names) {
                final Object kind = each.get(0);
                if (kind.equals(DNS_NAME) && isName(lower(each.get(1)), lower(host))
                        || kind.equals(ADDRESS) && isAddress((String) each.get(1), host)) {
                    return true;
                }
            }
        }
        return false;
    }

    /** Compares names; a star is one whole word at the beginning. */
    private static boolean isName(String named, String host) {
        final int dot = host.indexOf('.');
        return named.equals(host)
                || named.startsWith("*.") && dot > 0 && named.substring(1).equals(host.substring(dot));
    }

    private static boolean isAddress(String named, String host) {
        if (named.indexOf(':') < 0 || host.indexOf(':') < 0) {
            return named.equals(host);
        }
        try {
            // With a colon it is an address: no name is looked up.
            return InetAddress.getByName(named).equals(InetAddress.getByName(host));
        } catch (UnknownHostException wrong) {
            return false;
        }
    }

    private static String lower(Object name) {
        return ((String) name).toLowerCase(Locale.ROOT);
    }
}
