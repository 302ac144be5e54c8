package org.raspilot.up.loop;

/**
 * A monotonic clock. It must count the time for which the device sleeps, too, where it may: what
 * came before the sleep is that much older after it.
 */
public interface Clock {
    /** Returns the time in ns from some moment on, never less than before; on any thread. */
    long nowNs();
}
