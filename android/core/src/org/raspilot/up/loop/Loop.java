package org.raspilot.up.loop;

/**
 * The one thread that owns all of the core's state: code on it needs no lock.
 *
 * <p>A call's exception is reported to the {@link FaultListener} only.
 */
public interface Loop {
    /** Returns monotonic milliseconds from an arbitrary origin; may be called on any thread. */
    long nowMs();

    /** Runs {@code call} soon on the loop, calls in their order; may be called on any thread. */
    void post(Runnable call);

    /**
     * Runs {@code call} on the loop after {@code delayMs} milliseconds, a negative delay being 0.
     * Only on the loop.
     */
    Cancellable schedule(long delayMs, Runnable call);

    /** Returns the network whose listeners are called on this loop. */
    Network network();
}
