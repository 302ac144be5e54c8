package org.raspilot.up.ground;

import java.util.HashMap;
import java.util.Map;

/** Why nothing the aircraft sends is readable, by code (docs/security.md), without a full stop. */
final class KeyTexts {
    private static final Map<String, String> FAULTS = new HashMap<>();

    static {
        FAULTS.put("unknown_key", "the aircraft does not know this key: pair again");
        FAULTS.put("revoked", "the aircraft's owner has revoked this key");
        FAULTS.put("expired", "this key has expired");
        FAULTS.put("changed", "the key was changed on the aircraft: pair again");
        FAULTS.put("secrecy_required", "the aircraft requires secrecy, and the app cannot encrypt");
        FAULTS.put("no_session", "no protected session: the aircraft does not answer this key");
        FAULTS.put("key_missing", "the aircraft requires a key: pair this phone");
    }

    private KeyTexts() {
    }

    static String fault(String code) {
        final String text = FAULTS.get(code);
        return text == null ? code : text;
    }
}
