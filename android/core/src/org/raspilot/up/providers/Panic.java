package org.raspilot.up.providers;

/**
 * What the Raspberry Pi asked for in Panic Mode: no stream quicker than one message in its delay.
 *
 * <p>Every sender asks it (thesis 3.2.5). It ends by {@code panic: false} or with the link.
 */
public final class Panic {
    /** The longest delay that may be asked for, ms. */
    public static final long LONGEST_DELAY_MS = 10000;

    /** Is told when it begins, changes or ends. */
    public interface Listener {
        /** Tells that {@link Panic#delayMs} is another one now. */
        void onPanic();
    }

    /** Returns whether it holds. */
    public boolean isOn() {
        return delayMs() > 0;
    }

    /** Returns the delay, ms; 0: no panic. */
    public long delayMs() {
        return 0;
    }

    /** Returns the period that a stream of this own period keeps now, ms. */
    public long periodMs(long ownPeriodMs) {
        return Math.max(ownPeriodMs, delayMs());
    }
}
