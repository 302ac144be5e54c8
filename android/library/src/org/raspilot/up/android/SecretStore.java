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

/**
 * Secret texts in a private file of the application; from Android 6 on encrypted by a key of the
 * system's keystore, before that as the system protects private files.
 */
final class SecretStore {
    private static final String ENCRYPTED = "keystore ";
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private final SharedPreferences kept;

    SecretStore(Context context, String file) {
        kept = context.getApplicationContext().getSharedPreferences(file, Context.MODE_PRIVATE);
    }

    /** Returns the names of the texts, sorted. */
    Set<String> names() {
        return new TreeSet<>(kept.getAll().keySet());
    }

    /** Returns a text, null: there is none; throws GeneralSecurityException: it is not readable. */
    String get(String name) throws GeneralSecurityException, IOException {
        String value = kept.getString(name, null);
        if (value == null || !value.startsWith(ENCRYPTED)) {
            if (value != null && PairingStore.isInKeystore()) {
                // The system was older when it was kept.
                put(name, value);
            }
            return value;
        }
        if (Build.VERSION.SDK_INT < 23) {
            throw new GeneralSecurityException("Android 6 or later has encrypted it");
        }
        try {
            byte[] encrypted = Base64.decode(value.substring(ENCRYPTED.length()), Base64.NO_WRAP);
            return new String(KeystoreCipher.decrypt(encrypted), ASCII);
        } catch (IllegalArgumentException | ProviderException fault) {
            throw new GeneralSecurityException("not readable", fault);
        }
    }

    /**
     * Keeps a text in place of an older one of its name.
     *
     * @throws IllegalArgumentException with a sentence if this phone cannot keep it
     */
    void put(String name, String secret) {
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
    }

    void forget(String name) {
        kept.edit().remove(name).commit();
    }
}
