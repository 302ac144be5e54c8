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
     * Starts to deliver readings; the sensor may be faster or slower than the wanted period, ms.
     */
    void subscribe(long periodMs, SensorListener<R> listener);

    /** Ends the subscription of {@link #subscribe}; no effect without one. */
    void unsubscribe();
}
