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

/**
 * This phone's keys of aircraft, in a private file of the application; from Android 6 on encrypted
 * by a key of the system's keystore, before that as the system protects private files.
 */
public final class PairingStore {
    private static final String FILE = "up_keys";
    private static final String ENCRYPTED = "keystore ";
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private final SharedPreferences kept;

    public PairingStore(Context context) {
        kept = context.getApplicationContext().getSharedPreferences(FILE, Context.MODE_PRIVATE);
    }

    /** Returns whether the keystore of this phone's system encrypts the keys. */
    public static boolean isInKeystore() {
        return Build.VERSION.SDK_INT >= 23;
    }

    /** Returns the names of the aircraft whose keys are kept, sorted. */
    public Set<String> aircraft() {
        return new TreeSet<>(kept.getAll().keySet());
    }

    /**
     * Returns the key of an aircraft; null: there is none, and its link is plain.
     *
     * @throws IllegalArgumentException with a sentence if there is one and it cannot be read: the
     *     link must not become plain
     */
    public Pairing get(String aircraft) {
        String value = kept.getString(aircraft, null);
        if (value == null) {
            return null;
        }
        try {
            Pairing found = Pairing.parse(value.startsWith(ENCRYPTED)
                    ? decrypted(value.substring(ENCRYPTED.length())) : value);
            if (found != null && found.aircraft.equals(aircraft)) {
                if (isInKeystore() && !value.startsWith(ENCRYPTED)) {
                    // The system was older when it was paired.
                    put(found);
                }
                return found;
            }
        } catch (GeneralSecurityException | IOException | ProviderException fault) {
            throw unreadable(aircraft, fault);
        }
        throw unreadable(aircraft, null);
    }

    /**
     * Keeps a key in place of an older one of its aircraft.
     *
     * @throws IllegalArgumentException with a sentence if this phone cannot keep it
     */
    public void put(Pairing pairing) {
        String text = pairing.toText();
        if (Build.VERSION.SDK_INT >= 23) {
            try {
                text = ENCRYPTED + Base64.encodeToString(
                        KeystoreCipher.encrypt(text.getBytes(ASCII)), Base64.NO_WRAP);
            } catch (GeneralSecurityException | IOException | ProviderException fault) {
                throw new IllegalArgumentException("The phone's keystore fails: " + fault, fault);
            }
        }
        if (!kept.edit().putString(pairing.aircraft, text).commit()) {
            throw new IllegalArgumentException("The phone's storage is full");
        }
    }

    /** Removes the key of an aircraft. */
    public void forget(String aircraft) {
        kept.edit().remove(aircraft).commit();
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

    private static IllegalArgumentException unreadable(String aircraft, Exception fault) {
        return new IllegalArgumentException(
                "The key of " + aircraft + " cannot be read: forget it and pair again", fault);
    }
}
