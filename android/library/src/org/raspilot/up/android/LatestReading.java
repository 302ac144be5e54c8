package org.raspilot.up.android;

import java.util.concurrent.Executor;
import java.util.concurrent.atomic.AtomicReference;
import org.raspilot.up.providers.SensorListener;

/**
 * Brings readings from the system's threads to the loop; a reading that still waits when the next
 * one comes is replaced by it.
 *
 * @param <R> what one reading is
 */
final class LatestReading<R> implements Runnable {
    private final Executor loop;
    private final AtomicReference<R> waiting = new AtomicReference<>();
    private SensorListener<R> listener;

    LatestReading(Executor loop) {
        this.loop = loop;
    }

    /** Sets the receiver of the readings; null: none. Only on the loop. */
    void setListener(SensorListener<R> taker) {
        listener = taker;
        waiting.set(null);
    }

    /** Takes a reading; on any thread. */
    void put(R reading) {
        if (waiting.getAndSet(reading) == null) {
            loop.execute(this);
        }
    }

    @Override
    public void run() {
        R reading = waiting.getAndSet(null);
        if (reading != null && listener != null) {
            listener.onReading(reading);
        }
    }
}
