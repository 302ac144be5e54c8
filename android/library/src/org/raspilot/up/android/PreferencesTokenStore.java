package org.raspilot.up.android;

import android.content.Context;
import android.content.SharedPreferences;
import org.raspilot.up.ground.TokenStore;

/** Stores resume tokens in a private file of the application. */
final class PreferencesTokenStore implements TokenStore {
    private static final String FILE = "up_tokens";

    private final SharedPreferences tokens;

    PreferencesTokenStore(Context context) {
        tokens = context.getApplicationContext().getSharedPreferences(FILE, Context.MODE_PRIVATE);
    }

    @Override
    public String load(String key) {
        return tokens.getString(key, null);
    }

    @Override
    public void save(String key, String token) {
        tokens.edit().putString(key, token).apply();
    }

    @Override
    public void remove(String key) {
        tokens.edit().remove(key).apply();
    }
}
