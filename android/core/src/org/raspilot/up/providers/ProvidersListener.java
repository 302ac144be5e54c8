package org.raspilot.up.providers;

/** Is told on the loop what is missing or wrong of a provider. */
public interface ProvidersListener {
    /**
     * Tells a problem of a provider in a sentence, once until it changes; of one whose sensor is
     * absent the sensor's name, at each start.
     */
    void onProvider(String name, String sentence);
}
