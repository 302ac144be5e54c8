package org.raspilot.up.ground;

import java.util.HashMap;
import java.util.Map;

/**
 * Stores resume tokens beyond the life of the program: a ground that reconnects takes its seat back
 * immediately. Called on the loop; a store that cannot store anything stays empty, since a lost
 * token costs only three seconds of waiting.
 */
public interface TokenStore {
    /** Returns the token under that key, or null if absent. */
    String load(String key);

    void save(String key, String token);

    /** Drops a token: the seat was given up. */
    void remove(String key);

    /** Stores resume tokens until the program ends. Only on the loop. */
    static final class MemoryTokenStore implements TokenStore {
        private final Map<String, String> tokens = new HashMap<>();

        @Override
        public String load(String key) {
            return tokens.get(key);
        }

        @Override
        public void save(String key, String token) {
            tokens.put(key, token);
        }

        @Override
        public void remove(String key) {
            tokens.remove(key);
        }
    }
}
