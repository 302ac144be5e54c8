package org.raspilot.up.loop;

/**
 * A monotonic clock. Where possible it also counts the time for which the device sleeps: data from
 * before the sleep is that much older afterwards.
 */
public interface Clock {
    /** Returns the time in ns from an arbitrary origin, never decreasing; on any thread. */
    long nowNs();
}
