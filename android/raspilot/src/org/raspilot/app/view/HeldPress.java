package org.raspilot.app.view;

/**
 * A press that fires only when it is held: idle, pressed, then done or void.
 *
 * <p>Only a release leads back to idle, so one press fires once, and a void press stays void
 * however long it is still held. Times are milliseconds of one monotonic clock.
 */
public final class HeldPress {
    /** How long a press must last. */
    public static final long HOLD_MS = 1000;
    /** Maximum time between two checks: a screen that hung must not fire when it resumes. */
    public static final long MAX_CHECK_INTERVAL_MS = 400;

    public enum State {
        /** Nothing presses. */
        IDLE,
        /** It is held and the time runs. */
        PRESSED,
        /** It has lasted and has fired; it is still held. */
        DONE,
        /** It is void; it may still be held. */
        VOID
    }

    private State state = State.IDLE;
    private long beganMs;
    private long lookedMs;

    public State state() {
        return state;
    }

    /** Starts a press; no effect while one is in progress or void. */
    public void press(long nowMs) {
        if (state == State.IDLE) {
            state = State.PRESSED;
            beganMs = nowMs;
            lookedMs = nowMs;
        }
    }

    /** Ends a press; one that was too short has no effect. */
    public void release() {
        state = State.IDLE;
    }

    /** Makes a press in progress void until it is released. */
    public void cancel() {
        if (state == State.PRESSED) {
            state = State.VOID;
        }
    }

    /**
     * Checks the time.
     *
     * @return true once, when the press was held long enough
     */
    public boolean check(long nowMs) {
        if (state != State.PRESSED) {
            return false;
        }
        long sinceMs = nowMs - lookedMs;
        lookedMs = nowMs;
        if (sinceMs < 0 || sinceMs > MAX_CHECK_INTERVAL_MS) {
            state = State.VOID;
            return false;
        }
        if (nowMs - beganMs < HOLD_MS) {
            return false;
        }
        state = State.DONE;
        return true;
    }

    /** Returns how much of the press is done, 0 to 1. */
    public float progress(long nowMs) {
        if (state == State.DONE) {
            return 1;
        }
        if (state != State.PRESSED) {
            return 0;
        }
        return Math.max(0, Math.min(1, (nowMs - beganMs) / (float) HOLD_MS));
    }
}
