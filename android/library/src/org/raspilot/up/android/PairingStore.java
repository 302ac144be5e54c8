package org.raspilot.up.android;

import android.content.Context;
import android.os.Build;
import java.io.IOException;
import java.security.GeneralSecurityException;
import java.util.Set;
import org.raspilot.up.security.Pairing;

/** This phone's keys of aircraft, each under the aircraft's name. */
public final class PairingStore {
    private final SecretStore kept;

    public PairingStore(Context context) {
        kept = new SecretStore(context, "up_keys");
    }

    /** Returns whether the keystore of this phone's system encrypts the keys. */
    public static boolean isInKeystore() {
        return Build.VERSION.SDK_INT >= 23;
    }

    /** Returns the names of the aircraft whose keys are kept, sorted. */
    public Set<String> aircraft() {
        return kept.names();
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
            String text = kept.get(aircraft);
            Pairing found = text == null ? null : Pairing.parse(text);
            if (text == null || found != null && found.aircraft.equals(aircraft)) {
                return found;
            }
        } catch (GeneralSecurityException | IOException fault) {
            cause = fault;
        }
        throw new IllegalArgumentException(
                "The key of " + aircraft + " cannot be read: forget it and pair again", cause);
    }

    /**
     * Keeps a key in place of an older one of its aircraft.
     *
     * @throws IllegalArgumentException with a sentence if this phone cannot keep it
     */
    public void put(Pairing pairing) {
        kept.put(pairing.aircraft, pairing.toText());
    }

    /** Removes the key of an aircraft. */
    public void forget(String aircraft) {
        kept.forget(aircraft);
    }
}
