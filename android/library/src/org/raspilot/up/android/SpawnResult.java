package org.raspilot.up.android;

import android.os.Bundle;

/** The result of a spawn request, in the form of a message. Immutable. */
public final class SpawnResult {
    private static final String IS_RUNNING = "running";
    private static final String IS_SPAWNED = "spawned";
    private static final String SENTENCE = "sentence";
    private static final String PLACE = "place";
    private static final String PROXY_HOST = "proxy_host";
    private static final String PROXY_PORT = "proxy_port";

    private final Bundle values;

    private SpawnResult(Bundle values) {
        this.values = values;
    }

    /** Returns the result that an instance runs. */
    static SpawnResult running(boolean isSpawned, String sentence, String place,
            String proxyHost, int proxyPort) {
        Bundle values = new Bundle();
        values.putBoolean(IS_RUNNING, true);
        values.putBoolean(IS_SPAWNED, isSpawned);
        values.putString(SENTENCE, sentence == null ? "" : sentence);
        values.putString(PLACE, place);
        values.putString(PROXY_HOST, proxyHost);
        values.putInt(PROXY_PORT, proxyPort);
        return new SpawnResult(values);
    }

    /** Returns the result that nothing runs, and why. */
    static SpawnResult refused(String sentence) {
        Bundle values = new Bundle();
        values.putString(SENTENCE, sentence);
        return new SpawnResult(values);
    }

    /** Returns the result of {@link #toBundle}. */
    public static SpawnResult of(Bundle values) {
        return new SpawnResult(new Bundle(values));
    }

    /** Returns it in a form that a message carries. */
    Bundle toBundle() {
        return new Bundle(values);
    }

    public boolean isRunning() {
        return values.getBoolean(IS_RUNNING);
    }

    /** Returns whether this request started it. */
    public boolean isSpawned() {
        return values.getBoolean(IS_SPAWNED);
    }

    /** Returns the runner's message, or the reason for its absence, without a full stop. */
    public String sentence() {
        return values.getString(SENTENCE);
    }

    /** Returns the address of the instance, {@code host:general:orientation}, or null. */
    public String place() {
        return values.getString(PLACE);
    }

    /** Returns the proxy's host for the ground; null: absent. */
    public String proxyHost() {
        return values.getString(PROXY_HOST);
    }

    /** Returns the proxy's port for the ground; 0: absent. */
    public int proxyPort() {
        return values.getInt(PROXY_PORT);
    }
}
