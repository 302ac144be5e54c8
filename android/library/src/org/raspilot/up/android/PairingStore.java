package org.raspilot.up.android;

import android.content.Context;
import android.content.SharedPreferences;
import android.os.Build;
import android.util.Base64;
import java.io.IOException;
import java.nio.charset.Charset;
import java.security.GeneralSecurityException;
import java.security.ProviderException;
import java.util.Set;
import java.util.TreeSet;
import org.raspilot.up.android.api23.KeystoreCipher;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsException;
import org.raspilot.up.tls.TlsIdentity;

/**
 * This phone's keys of aircraft and its certificates for TLS, in a private file of the application;
 * from Android 6 on encrypted by a key of the system's keystore, before that as the system protects
 * private files.
 */
public final class PairingStore {
    private static final String FILE = "up_keys";
    /** The names alone: the system shows a file that it cannot read as an empty one. */
    private static final String NAMES = "up_key_names";
    private static final String CERTIFICATES = "tls:";
    private static final String ENCRYPTED = "keystore ";
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private final SharedPreferences kept;
    private final SharedPreferences names;

    public PairingStore(Context context) {
        Context application = context.getApplicationContext();
        kept = application.getSharedPreferences(FILE, Context.MODE_PRIVATE);
        names = application.getSharedPreferences(NAMES, Context.MODE_PRIVATE);
    }

    /** Returns whether the keystore of this phone's system encrypts the keys. */
    public static boolean isInKeystore() {
        return Build.VERSION.SDK_INT >= 23;
    }

    /** Returns the names of the aircraft whose keys are kept, readable or not, sorted. */
    public Set<String> aircraft() {
        Set<String> found = new TreeSet<>(kept.getAll().keySet());
        found.addAll(names.getAll().keySet());
        found.remove(CERTIFICATES);
        return found;
    }

    /**
     * Returns the key of an aircraft; null: there is none, and its link is plain.
     *
     * @throws IllegalArgumentException with a sentence if there is one and it cannot be read: the
     *     link must not become plain
     */
    public Pairing get(String aircraft) {
        Exception cause = null;
        try {
            String text = text(aircraft);
            Pairing found = text == null ? null : Pairing.parse(text);
            if (text == null || found != null && found.aircraft.equals(aircraft)) {
                return found;
            }
        } catch (GeneralSecurityException | IOException | ProviderException fault) {
            cause = fault;
        }
        throw new IllegalArgumentException(
                "The key of " + aircraft + " cannot be read: forget it and pair again", cause);
    }

    /**
     * Returns the certificates for TLS; null: there are none.
     *
     * @throws IllegalArgumentException with a sentence if they cannot be read
     */
    public TlsIdentity certificates() {
        try {
            String text = text(CERTIFICATES);
            return text == null ? null : TlsIdentity.parse(text);
        } catch (GeneralSecurityException | IOException | ProviderException fault) {
            throw new IllegalArgumentException(
                    "The certificates for TLS cannot be read: choose their file again", fault);
        }
    }

    /**
     * Keeps a key in place of an older one of its aircraft.
     *
     * @throws IllegalArgumentException with a sentence if this phone cannot keep it
     */
    public void put(Pairing pairing) {
        put(pairing.aircraft, pairing.toText());
    }

    /**
     * Keeps the text of the files of {@code up certificates device}.
     *
     * @throws IllegalArgumentException with a sentence if it is another text, or if this phone
     *     cannot keep it
     */
    public void putCertificates(String text) {
        try {
            TlsIdentity.parse(text);
        } catch (TlsException fault) {
            throw new IllegalArgumentException("The file is not used: " + fault.getMessage(), fault);
        }
        put(CERTIFICATES, text);
    }

    private void put(String name, String secret) {
        String text = secret;
        if (Build.VERSION.SDK_INT >= 23) {
            try {
                text = ENCRYPTED + Base64.encodeToString(
                        KeystoreCipher.encrypt(text.getBytes(ASCII)), Base64.NO_WRAP);
            } catch (GeneralSecurityException | IOException | ProviderException fault) {
                throw new IllegalArgumentException("The phone's keystore fails: " + fault, fault);
            }
        }
        if (!kept.edit().putString(name, text).commit()) {
            throw new IllegalArgumentException("The phone's storage is full");
        }
        names.edit().putBoolean(name, true).commit();
    }

    public void forget(String aircraft) {
        kept.edit().remove(aircraft).commit();
        names.edit().remove(aircraft).commit();
    }

    public void forgetCertificates() {
        forget(CERTIFICATES);
    }

    /** Returns a text, null: there is none. */
    private String text(String name) throws GeneralSecurityException, IOException {
        String value = kept.getString(name, null);
        if (value != null && value.startsWith(ENCRYPTED)) {
            return decrypted(value.substring(ENCRYPTED.length()));
        }
        if (value != null && isInKeystore()) {
            // The system was older when it was kept.
            put(name, value);
        }
        if (value == null && names.contains(name)) {
            throw new GeneralSecurityException("it was kept, and is gone");
        }
        return value;
    }

    private static String decrypted(String value) throws GeneralSecurityException, IOException {
        if (Build.VERSION.SDK_INT < 23) {
            throw new GeneralSecurityException("Android 6 or later has encrypted it");
        }
        try {
            return new String(KeystoreCipher.decrypt(Base64.decode(value, Base64.NO_WRAP)), ASCII);
        } catch (IllegalArgumentException fault) {
            throw new GeneralSecurityException("not base 64", fault);
        }
    }
}
