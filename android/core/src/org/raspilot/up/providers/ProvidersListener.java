package org.raspilot.up.providers;

/** Receives the problems of providers, on the loop. */
public interface ProvidersListener {
    /**
     * Tells a problem of a provider in a sentence, once until it changes; of one whose sensor is
     * absent the sensor's name, at each start.
     */
    void onProvider(String name, String sentence);
}
