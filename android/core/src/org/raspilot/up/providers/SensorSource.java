package org.raspilot.up.providers;

/**
 * One kind of sensor of this device, whatever measures behind it (thesis 4.5.2, "Providers").
 *
 * <p>Android's parts and the simulated ones on the JVM implement it. All calls come on the loop,
 * and readings are handed over on the loop.
 *
 * @param <R> what one reading is
 */
public interface SensorSource<R> {
    /** Returns whether this device has the sensor; false is an answer, never an error. */
    boolean isPresent();

    /** Returns what the sensor calls itself, for the screen and the log. */
    String name();

    /**
     * Begins to measure and to hand readings to the listener.
     *
     * @param periodMs how often a reading is wanted, ms; the sensor may be quicker or slower
     * @param listener who takes the readings; one at a time
     */
    void subscribe(long periodMs, SensorListener<R> listener);

    /** Ends what {@link #subscribe} began; without a subscription nothing happens. */
    void unsubscribe();
}
