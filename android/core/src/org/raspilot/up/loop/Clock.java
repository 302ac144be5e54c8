package org.raspilot.up.loop;

/**
 * A monotonic clock. Where possible it also counts the time for which the device sleeps: data from
 * before the sleep is that much older afterwards.
 */
public interface Clock {
    /** Returns the time in ns from some moment on, never less than before; on any thread. */
    long nowNs();
}
