package org.raspilot.up.providers;

/**
 * Takes the readings of a {@link SensorSource}.
 *
 * @param <R> what one reading is
 */
public interface SensorListener<R> {
    /** Takes the newest reading; called on the loop. */
    void onReading(R reading);
}
