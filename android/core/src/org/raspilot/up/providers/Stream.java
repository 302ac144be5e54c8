package org.raspilot.up.providers;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/**
 * Decides when a provider sends: its newest reading, once, as its cadence and Panic allow.
 *
 * <p>A reading leaves when it comes, a little before or after it is due, so that what leaves is
 * fresh; one that came too early leaves late only when no newer one took its place.
 */
final class Stream implements Panic.Listener {
    private static final double NEVER = Double.POSITIVE_INFINITY;

    private final Loop loop;
    private final Panic panic;
    private final RatePolicy ratePolicy;
    private final UpProvider provider;
    private final RateMeter rate = new RateMeter();
    private final Runnable pumping = () -> sendIfDue(false);
    private Cancellable timer = Cancellable.DONE;
    private boolean isRunning;
    private boolean isFirst;
    private boolean isUnsent;
    private long newestMs = -1;
    private long lastMs;
    private double dueMs;

    Stream(Loop loop, Panic panic, RatePolicy ratePolicy, UpProvider provider) {
        this.loop = loop;
        this.panic = panic;
        this.ratePolicy = ratePolicy;
        this.provider = provider;
    }

    void begin() {
        isRunning = true;
        isFirst = true;
        isUnsent = false;
        newestMs = -1;
        panic.addListener(this);
    }

    /** Stops; nothing is sent afterwards. */
    void end() {
        isRunning = false;
        timer.cancel();
        panic.removeListener(this);
    }

    /** Takes a new reading; it is sent if it is news. */
    void offer(boolean isNew) {
        newestMs = loop.nowMs();
        isUnsent |= isNew;
        sendIfDue(true);
    }

    /** Notes a new link: known values that still hold are sent immediately. */
    void reopen() {
        isFirst = true;
        isUnsent = newestMs >= 0;
        sendIfDue(true);
    }

    @Override
    public void onPanic(Panic now) {
        sendIfDue(true);
    }

    /** Returns when the newest reading came; -1: none since the beginning. */
    long newestMs() {
        return newestMs;
    }

    /** Returns how many left in the last second, Hz. */
    double hz() {
        return rate.hz(loop.nowMs());
    }

    /** Sends a due value; a reading that arrived just now may be sent slightly early. */
    private void sendIfDue(boolean isPrompt) {
        timer.cancel();
        long nowMs = loop.nowMs();
        double wantedMs = wantedMs();
        if (wantedMs == NEVER || !provider.isOpen()) {
            return;
        }
        if (nowMs >= (isPrompt ? promptMs(wantedMs) : wantedMs)) {
            emit(nowMs);
            wantedMs = wantedMs();
        }
        if (wantedMs != NEVER) {
            timer = loop.schedule(Math.max(1, (long) Math.ceil(wantedMs - nowMs)), pumping);
        }
    }

    /** Returns when the newest reading leaves if no newer one comes. */
    private double wantedMs() {
        if (!isRunning || newestMs < 0) {
            return NEVER;
        }
        if (isUnsent) {
            return isFirst ? 0 : Math.max(dueMs, earliestMs()) + ratePolicy.toleranceMs();
        }
        return ratePolicy.isLevel() ? lastMs + panic.periodMs(ratePolicy.repeatMs) : NEVER;
    }

    /** Returns the time from which a new reading is sent immediately. */
    private double promptMs(double wantedMs) {
        return isUnsent && !isFirst
                ? Math.max(dueMs - ratePolicy.toleranceMs(), earliestMs())
                : wantedMs;
    }

    private double earliestMs() {
        return panic.isOn() ? lastMs + panic.delayMs() : 0;
    }

    private void emit(long nowMs) {
        isUnsent = false;
        if (nowMs - newestMs > ratePolicy.maxAgeMs) {
            return;
        }
        // A message that leaves late does not shift those after it, one that is a period late does.
        boolean isInStep = !isFirst && nowMs < dueMs + ratePolicy.periodMs;
        dueMs = (isInStep ? dueMs : nowMs) + ratePolicy.periodMs;
        isFirst = false;
        lastMs = nowMs;
        if (provider.transmit()) {
            rate.count(nowMs);
        }
    }
}
