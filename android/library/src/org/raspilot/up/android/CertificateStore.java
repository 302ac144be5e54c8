package org.raspilot.up.android;

import android.content.Context;
import java.io.IOException;
import java.security.GeneralSecurityException;
import org.raspilot.up.tls.TlsException;
import org.raspilot.up.tls.TlsIdentity;

/** This phone's certificates for TLS, kept as its keys are. */
public final class CertificateStore {
    private static final String NAME = "certificates";

    private final SecretStore kept;

    public CertificateStore(Context context) {
        kept = new SecretStore(context, "up_tls");
    }

    /**
     * Returns the certificates; null: there are none.
     *
     * @throws IllegalArgumentException with a sentence if they cannot be read
     */
    public TlsIdentity get() {
        try {
            String text = kept.get(NAME);
            return text == null ? null : TlsIdentity.parse(text);
        } catch (GeneralSecurityException | IOException fault) {
            throw new IllegalArgumentException(
                    "The certificates for TLS cannot be read: choose their file again", fault);
        }
    }

    /**
     * Keeps the text of the files of {@code up certificates device}.
     *
     * @throws IllegalArgumentException with a sentence if it has no certificates, or if this phone
     *     cannot keep it
     */
    public void put(String text) {
        try {
            TlsIdentity.parse(text);
        } catch (TlsException fault) {
            throw new IllegalArgumentException("The file is not used: " + fault.getMessage(), fault);
        }
        kept.put(NAME, text);
    }

    /** Removes the certificates. */
    public void forget() {
        kept.forget(NAME);
    }
}
