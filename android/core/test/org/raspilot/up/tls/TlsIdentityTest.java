package org.raspilot.up.tls;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.security.cert.CertificateParsingException;
import java.util.Arrays;
import java.util.Collection;
import java.util.List;
import org.junit.Test;

/** The files of `up certificates device`, and the names in a certificate. */
public final class TlsIdentityTest {
    private static final String BEGIN = "-----BEGIN ";
    private static final Collection<List<?>> NAMES = Arrays.asList(name(2, "Relay.example.org"),
            name(2, "*.up.example.org"), name(7, "192.0.2.7"), name(7, "2001:db8:0:0:0:0:0:7"),
            name(1, "mail.example.org"));
    private static final String OTHER_KEY = "-----BEGIN PRIVATE KEY-----\n"
            + "MIGHAgEAMBMGByqGSM49AgEGCCqGSM49AwEHBG0wawIBAQQg7UhUjAqG8f8BvjpQ\n"
            + "PxSk8g6x5EaOezXvokdxxITi06OhRANCAAQApK7uzX10PK1EYnwQmxD0jW+D+SiX\n"
            + "K5kkUTkpzPiuVDA8d8OSA2BUH5aAOCeaZ+AEGeK4edYjActlroDLP0E6\n"
            + "-----END PRIVATE KEY-----\n";

    private static List<?> name(int kind, String value) {
        return Arrays.asList(kind, value);
    }

    private static boolean isNamed(String host) throws CertificateParsingException {
        return ServerTrust.isNamed(NAMES, host);
    }

    private static void refused(String text) {
        assertEquals("tls_bad_file",
                assertThrows(TlsException.class, () -> TlsIdentity.parse(text)).code);
    }

    @Test
    public void thePartsOfAFileInAnyOrder() throws Exception {
        final String[] parts = TlsConnectionTest.text().split("(?=-----BEGIN )");
        final TlsIdentity found = TlsIdentity.parse("# mine\r\n" + parts[2] + parts[1] + parts[0]);
        assertTrue(found.toString(), found.toString().startsWith("CN=relay until 212"));
        assertEquals("no certificate", TlsIdentity.parse(parts[0]).toString());
    }

    @Test
    public void aFileThatIsNoneIsRefused() throws Exception {
        final String[] parts = TlsConnectionTest.text().split("(?=-----BEGIN )");
        refused("");
        refused("upkey:1:glider-1");
        refused(parts[1] + parts[2]);
        refused(parts[0] + parts[1]);
        refused(parts[0] + parts[2]);
        refused(parts[0] + parts[1] + OTHER_KEY);
        refused(parts[0].substring(0, 200) + "-----END CERTIFICATE-----");
        refused(parts[0] + parts[1] + parts[2].replace("M", "N"));
        refused(parts[0] + parts[1] + parts[2].replace("PRIVATE", "EC PRIVATE"));
        refused(parts[0] + parts[1] + parts[2] + BEGIN + "X509 CRL-----\nMIIB");
        refused(parts[0] + BEGIN + "X509 CRL-----\nAAAA\n-----END X509 CRL-----\n");
    }

    @Test
    public void aNameIsFoundAndNoOther() throws Exception {
        for (String each : new String[] {"relay.example.org", "RELAY.EXAMPLE.ORG", "192.0.2.7",
            "a.up.example.org", "2001:db8::7"}) {
            assertEquals(each, true, isNamed(each));
        }
        for (String each : new String[] {"example.org", "other.example.org", "up.example.org",
            "a.b.up.example.org", "192.0.2.70", "2001:db8::8", "mail.example.org", "", "*",
            "relay.example.org.evil.net", ".up.example.org"}) {
            assertEquals(each, false, isNamed(each));
        }
        assertEquals(false, ServerTrust.isNamed(null, "relay.example.org"));
    }
}
