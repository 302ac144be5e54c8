package org.raspilot.up.ground;

/**
 * Keeps resume tokens where they outlive the program: a ground that comes back takes its seat at
 * once. Called on the loop; a store that cannot keep anything keeps nothing, a lost token costs
 * three seconds of waiting.
 */
public interface TokenStore {
    /** Returns the token under that key; null: there is none. */
    String load(String key);

    /** Keeps a token. */
    void save(String key, String token);

    /** Drops a token: the seat was given up. */
    void forget(String key);
}
