package org.raspilot.up.ground;

import java.util.HashMap;
import java.util.Map;

/** Stores resume tokens until the program ends. Only on the loop. */
public final class MemoryTokenStore implements TokenStore {
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
