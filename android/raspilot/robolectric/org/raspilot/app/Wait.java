package org.raspilot.app;

import static org.junit.Assert.fail;

import java.time.Duration;
import org.robolectric.shadows.ShadowLooper;

/** Waits for what other threads and real sockets bring, while the main thread does its work. */
final class Wait {
    private static final long MAX_NS = 30L * 1000 * 1000 * 1000;
    private static final long PAUSE_MS = 2;

    private Wait() {
    }

    interface Condition {
        boolean holds() throws Exception;
    }

    /** Runs the main thread until a condition holds; fails after a long timeout. */
    static void until(String what, Condition condition) throws Exception {
        long endNs = System.nanoTime() + MAX_NS;
        ShadowLooper.idleMainLooper();
        while (!condition.holds()) {
            if (System.nanoTime() - endNs > 0) {
                fail("never came: " + what);
            }
            Thread.sleep(PAUSE_MS);
            ShadowLooper.idleMainLooper();
        }
    }

    /** Advances the main thread's time, ms: its timers run, the sockets' do not. */
    static void pass(long ms) {
        ShadowLooper.idleMainLooper();
        ShadowLooper.shadowMainLooper().idleFor(Duration.ofMillis(ms));
    }
}
