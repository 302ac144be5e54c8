package org.raspilot.up.providers;

/** Receives the problems of providers, on the loop. */
public interface ProvidersListener {
    /**
     * Called with a problem of a provider in a sentence, once until it changes; for an absent
     * sensor with the sensor's name, at each start.
     */
    void onProvider(String name, String sentence);
}
