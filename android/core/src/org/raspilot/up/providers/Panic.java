package org.raspilot.up.providers;

import java.util.ArrayList;
import java.util.List;

/**
 * The Raspberry Pi's limit in Panic Mode: each stream sends at most one message per delay.
 *
 * <p>Every sender obeys it, orientation included, in each mode; the Raspberry Pi does not send it
 * to a phone that its controller flies by (thesis 3.2.5). It ends by {@code panic: false} or with
 * the link.
 */
public final class Panic {
    /** The maximum delay of a request, ms. */
    public static final long MAX_DELAY_MS = 10000;

    private final List<Listener> listeners = new ArrayList<>();
    private long delayMs;

    /** Called when it starts, changes or ends. */
    public interface Listener {
        /** Called when {@link Panic#delayMs} has changed. */
        void onPanic(Panic panic);
    }

    /**
     * Starts, or changes the delay, 0 to 10000 ms; throws IllegalArgumentException (a sentence).
     */
    public void apply(double wantedMs) {
        if (!(wantedMs >= 0 && wantedMs <= MAX_DELAY_MS)) {
            throw new IllegalArgumentException("delay_ms: 0 to " + MAX_DELAY_MS);
        }
        setDelayMs((long) Math.ceil(wantedMs));
    }

    /** Ends: by {@code panic: false}, or because the link that requested it is lost. */
    public void clear() {
        setDelayMs(0);
    }

    public boolean isOn() {
        return delayMs > 0;
    }

    /** Returns the delay, ms; 0: no panic. */
    public long delayMs() {
        return delayMs;
    }

    /** Returns the current period of a stream with that normal period, ms. */
    public long periodMs(long ownPeriodMs) {
        return Math.max(ownPeriodMs, delayMs);
    }

    /** Adds a listener of changes, called in the order of registration. */
    public void addListener(Listener listener) {
        listeners.add(listener);
    }

    public void removeListener(Listener listener) {
        listeners.remove(listener);
    }

    private void setDelayMs(long newMs) {
        if (newMs == delayMs) {
            return;
        }
        delayMs = newMs;
        for (Listener listener : new ArrayList<>(listeners)) {
            listener.onPanic(this);
        }
    }
}
