package org.raspilot.up.tls;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.Charset;
import java.security.GeneralSecurityException;
import java.security.KeyFactory;
import java.security.KeyStore;
import java.security.PrivateKey;
import java.security.Signature;
import java.security.cert.Certificate;
import java.security.cert.CertificateFactory;
import java.security.cert.X509CRL;
import java.security.cert.X509Certificate;
import java.security.spec.PKCS8EncodedKeySpec;
import java.text.SimpleDateFormat;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.net.ssl.KeyManagerFactory;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLEngine;
import javax.net.ssl.TrustManager;
import javax.net.ssl.TrustManagerFactory;
import javax.net.ssl.X509TrustManager;

/**
 * The CA that this device trusts and the certificate that it presents: the files of {@code up
 * certificates device} in one text, in any order. Without a certificate it presents none.
 *
 * <p>Immutable. Source: docs/security.md, "TLS".
 */
public final class TlsIdentity {
    private static final Pattern PART = Pattern.compile(
            "-----BEGIN ([A-Z0-9 ]+)-----([A-Za-z0-9+/=\\s]+)-----END \\1-----");
    private static final String DIGITS =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    private static final List<String> VERSIONS = Arrays.asList("TLSv1.2", "TLSv1.3");
    private static final char[] NO_PASSWORD = new char[0];

    private final String text;
    private final List<X509CRL> revoked = new ArrayList<>();
    private final KeyManagerFactory keys;
    private final X509TrustManager authorities;

    private TlsIdentity(String pem) throws GeneralSecurityException, IOException {
        final CertificateFactory factory = CertificateFactory.getInstance("X.509");
        final KeyStore trusted = emptyStore();
        final List<X509Certificate> own = new ArrayList<>();
        byte[] key = null;
        final Matcher parts = PART.matcher(pem);
        int missing = pem.split("-----BEGIN ", -1).length - 1;
        while (parts.find()) {
            missing -= 1;
            final InputStream part =
                    new ByteArrayInputStream(parts.group().getBytes(Charset.forName("US-ASCII")));
            if (parts.group(1).equals("PRIVATE KEY")) {
                key = decoded(parts.group(2));
            } else if (parts.group(1).equals("X509 CRL")) {
                revoked.add((X509CRL) factory.generateCRL(part));
            } else {
                final X509Certificate each = (X509Certificate) factory.generateCertificate(part);
                if (each.getBasicConstraints() < 0) {
                    own.add(each);
                } else {
                    trusted.setCertificateEntry("ca" + trusted.size(), each);
                }
            }
        }
        if (missing != 0) {
            throw bad("a part of it is cut off");
        }
        if (trusted.size() == 0) {
            throw bad("it has no certificate of a CA (ca.pem)");
        }
        if (own.isEmpty() != (key == null)) {
            throw bad("of certificate.pem and key.pem one is missing");
        }
        for (X509CRL list : revoked) {
            requireOurs(list, trusted);
        }
        final KeyStore presented = emptyStore();
        if (key != null) {
            presented.setKeyEntry("device", keyOf(own.get(0), key), NO_PASSWORD,
                    own.toArray(new Certificate[own.size()]));
        }
        text = own.isEmpty() ? "no certificate"
                : own.get(0).getSubjectX500Principal().getName() + " until "
                        + new SimpleDateFormat("yyyy-MM-dd", Locale.ROOT)
                                .format(own.get(0).getNotAfter());
        keys = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
        keys.init(presented, NO_PASSWORD);
        final TrustManagerFactory trust =
                TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        trust.init(trusted);
        authorities = (X509TrustManager) trust.getTrustManagers()[0];
    }

    /**
     * Reads the text of {@code ca.pem} and, as far as there are, {@code certificate.pem}, {@code
     * key.pem} and {@code revoked.pem}.
     *
     * @throws TlsException tls_bad_file, with a sentence about the text
     */
    public static TlsIdentity parse(String text) throws TlsException {
        try {
            return new TlsIdentity(text);
        } catch (TlsException wrong) {
            throw wrong;
        } catch (GeneralSecurityException | IOException | RuntimeException wrong) {
            throw bad("a part of it is broken: " + wrong.getMessage());
        }
    }

    /** Returns the subject of the own certificate and its last day. */
    @Override
    public String toString() {
        return text;
    }

    /** Returns the judge of the certificate of the server that is called so. */
    ServerTrust trust(String host) {
        return new ServerTrust(authorities, revoked, host);
    }

    /**
     * Returns a client's engine of TLS 1.2 or later; takes long. Each has its own context, so that
     * no session is resumed: the certificates are checked every time.
     */
    SSLEngine engine(String host, int port, ServerTrust trust) throws GeneralSecurityException {
        final SSLContext context = SSLContext.getInstance("TLS");
        context.init(keys.getKeyManagers(), new TrustManager[] {trust}, null);
        // The host is the server's name in the ClientHello, too.
        final SSLEngine engine = context.createSSLEngine(host, port);
        engine.setUseClientMode(true);
        final List<String> versions = new ArrayList<>(VERSIONS);
        versions.retainAll(Arrays.asList(engine.getSupportedProtocols()));
        if (versions.isEmpty()) {
            throw new TlsException("tls_too_old", "this system has no TLS 1.2: Android 5 has it");
        }
        engine.setEnabledProtocols(versions.toArray(new String[versions.size()]));
        return engine;
    }

    private static void requireOurs(X509CRL list, KeyStore trusted)
            throws GeneralSecurityException {
        for (String alias : Collections.list(trusted.aliases())) {
            final X509Certificate each = (X509Certificate) trusted.getCertificate(alias);
            if (each.getSubjectX500Principal().equals(list.getIssuerX500Principal())) {
                list.verify(each.getPublicKey());
                return;
            }
        }
        throw bad("its list of revoked certificates is not of its CA");
    }

    private static PrivateKey keyOf(X509Certificate certificate, byte[] encoded)
            throws GeneralSecurityException {
        final String algorithm = certificate.getPublicKey().getAlgorithm();
        final PrivateKey key = KeyFactory.getInstance(algorithm)
                .generatePrivate(new PKCS8EncodedKeySpec(encoded));
        final Signature proof = Signature.getInstance(
                algorithm.startsWith("EC") ? "SHA256withECDSA" : "SHA256with" + algorithm);
        proof.initSign(key);
        final byte[] signed = proof.sign();
        proof.initVerify(certificate.getPublicKey());
        if (!proof.verify(signed)) {
            throw bad("its key is not that of its certificate");
        }
        return key;
    }

    private static KeyStore emptyStore() throws GeneralSecurityException, IOException {
        final KeyStore store = KeyStore.getInstance(KeyStore.getDefaultType());
        store.load(null, null);
        return store;
    }

    /** Returns the bytes of base 64, which Android's Java has from 8 on. */
    private static byte[] decoded(String text) {
        final ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        int value = 0;
        int bits = 0;
        for (char each : text.toCharArray()) {
            final int digit = DIGITS.indexOf(each);
            if (digit >= 0) {
                value = value << 6 | digit;
                bits += 6;
                if (bits >= 8) {
                    bits -= 8;
                    bytes.write(value >> bits);
                }
            }
        }
        return bytes.toByteArray();
    }

    private static TlsException bad(String sentence) {
        return new TlsException("tls_bad_file", sentence);
    }
}
