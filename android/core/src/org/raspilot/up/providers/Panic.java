package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;

/**
 * What the Raspberry Pi asks for in Panic Mode: no stream quicker than one message in its delay.
 *
 * <p>Every sender keeps to it, orientation too, in each mode; the Raspberry Pi does not ask a phone
 * that its controller flies by (thesis 3.2.5). It ends by {@code panic: false} or with the link.
 */
public final class Panic {
    /** The longest delay that may be asked for, ms. */
    public static final long LONGEST_DELAY_MS = 10000;

    private final List<Listener> listeners = new ArrayList<Listener>();
    private long delayMs;

    /** Called when it starts, changes or ends. */
    public interface Listener {
        /** Called when {@link Panic#delayMs} has changed. */
        void onPanic(Panic panic);
    }

    /**
     * Begins, or takes another delay.
     *
     * @param wantedMs 0 to 10000; a fraction counts as the next whole one
     * @throws IllegalArgumentException when it is out of range (a sentence)
     */
    public void follow(double wantedMs) {
        if (!(wantedMs >= 0 && wantedMs <= LONGEST_DELAY_MS)) {
            throw new IllegalArgumentException("delay_ms: 0 to " + LONGEST_DELAY_MS);
        }
        become((long) Math.ceil(wantedMs));
    }

    /** Ends: calm came back, or the link that asked for it is gone. */
    public void forget() {
        become(0);
    }

    /** Returns whether it holds. */
    public boolean isOn() {
        return delayMs > 0;
    }

    /** Returns the delay, ms; 0: no panic. */
    public long delayMs() {
        return delayMs;
    }

    /** Returns the period that a stream of this own period keeps now, ms. */
    public long periodMs(long ownPeriodMs) {
        return Math.max(ownPeriodMs, delayMs);
    }

    /** Tells this one of changes, in the order of their coming, until it is removed. */
    public void addListener(Listener listener) {
        listeners.add(listener);
    }

    /** Tells this one no more. */
    public void removeListener(Listener listener) {
        listeners.remove(listener);
    }

    private void become(long newMs) {
        if (newMs == delayMs) {
            return;
        }
        delayMs = newMs;
        for (Listener listener : new ArrayList<Listener>(listeners)) {
            listener.onPanic(this);
        }
    }
}
