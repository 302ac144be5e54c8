package org.raspilot.up.loop;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.Rule;
import org.junit.Test;

public final class SelectorLoopTest {
    @Rule
    public final RunningLoop running = new RunningLoop();
    private final SelectorLoop loop = running.loop;
    private final List<String> done = new ArrayList<>();

    @Test
    public void callsOfManyThreadsRunOnTheLoopEachThreadsInTheirOrder() throws Exception {
        final int threads = 4;
        final int calls = 2000;
        final int[] next = new int[threads];
        final Thread[] all = new Thread[threads];
        for (int i = 0; i < threads; i++) {
            final int thread = i;
            all[i] = new Thread(() -> {
                for (int j = 0; j < calls; j++) {
                    final int number = j;
                    loop.post(() -> {
                        assertTrue(loop.isInLoop());
                        assertEquals(next[thread]++, number);
                    });
                }
            });
            all[i].start();
        }
        for (Thread each : all) {
            each.join();
        }
        assertFalse(loop.isInLoop());
        running.await("every call", () ->
                Arrays.equals(next, new int[] {calls, calls, calls, calls}));
        running.faults.mustBeNone();
    }

    @Test
    public void timersRunInOrderNeverEarlyAndNotWhenCancelled() {
        final long[] began = new long[1];
        final long[] ended = new long[1];
        running.call(() -> {
            began[0] = loop.nowMs();
            loop.schedule(40, () -> {
                ended[0] = loop.nowMs();
                done.add("last");
            });
            loop.schedule(20, note("second"));
            loop.schedule(10, note("first"));
            final Cancellable cancelled = loop.schedule(15, note("cancelled"));
            cancelled.cancel();
            return null;
        });
        running.await("the last timer", has("last"));
        assertEquals(Arrays.asList("first", "second", "last"), done);
        assertTrue(ended[0] - began[0] >= 40);
    }

    @Test
    public void aTimerThatAsksForItselfAtOnceStarvesNobody() {
        final boolean[] isOver = new boolean[1];
        loop.post(new Runnable() {
            @Override
            public void run() {
                if (!isOver[0]) {
                    loop.schedule(0, this);
                }
            }
        });
        loop.post(note("other"));
        running.await("another call", has("other"));
        running.call(() -> {
            isOver[0] = true;
            return null;
        });
    }

    @Test
    public void whatOneCallThrowsIsToldAndHarmsNoOther() {
        loop.post(thrower(new IllegalStateException("a call")));
        loop.post(thrower(new NoClassDefFoundError("newer than this phone")));
        loop.post(() -> {
            loop.schedule(1, thrower(new IllegalStateException("a timer")));
            loop.schedule(1, note("other"));
        });
        running.await("the other timer", has("other"));
        assertEquals(3, running.faults.all().size());
        assertEquals("a timer", running.faults.all().get(2).getMessage());
    }

    @Test
    public void aListenerOfFaultsThatThrowsEndsNothing() throws Exception {
        final SelectorLoop other = new SelectorLoop("other", fault -> {
            throw new IllegalStateException("the listener itself");
        });
        other.start();
        final CountDownLatch latch = new CountDownLatch(1);
        other.post(thrower(new IllegalStateException("a call")));
        other.post(() -> latch.countDown());
        assertTrue(latch.await(20, TimeUnit.SECONDS));
        other.stop();
    }

    @Test
    public void anIdleLoopSleeps() {
        running.pass(1);
        final long before = loop.rounds();
        running.pass(300);
        final long rounds = loop.rounds() - before;
        assertTrue("woke " + rounds + " times", rounds <= 6);
    }

    @Test
    public void aSleepOfTheDeviceIsTimeThatPassed() {
        final long[] asked = new long[1];
        running.call(() -> {
            asked[0] = loop.nowMs();
            loop.schedule(600000, note("after ten minutes"));
            return null;
        });
        running.sleep(600000);
        running.await("the timer", has("after ten minutes"));
        assertTrue(loop.nowMs() - asked[0] >= 600000);
    }

    @Test
    public void timeAndSocketsAreForTheLoopAlone() {
        assertThrows(IllegalStateException.class, () -> loop.schedule(0, note("never")));
        assertThrows(IllegalStateException.class, () -> loop.connectTcp("127.0.0.1", 1, 1, null));
    }

    @Test
    public void stopEndsTheThreadAndForgetsWhatWaits() throws Exception {
        final Thread thread = running.call(() -> {
            loop.schedule(0, note("never"));
            loop.stop();
            loop.post(note("never"));
            return Thread.currentThread();
        });
        thread.join(1000);
        assertFalse(thread.isAlive());
        loop.stop();
        loop.post(note("never"));
        assertTrue(done.isEmpty());
        assertThrows(IllegalStateException.class, () -> loop.start());
    }

    @Test
    public void stopFromAnotherThreadReturnsAfterTheEnd() {
        final Thread thread = running.call(() -> Thread.currentThread());
        loop.stop();
        assertFalse(thread.isAlive());
    }

    @Test
    public void aLoopThatWasNeverStartedCanBeStopped() {
        final SelectorLoop other = new SelectorLoop("other", running.faults);
        other.post(note("never"));
        other.stop();
        assertTrue(done.isEmpty());
    }

    @Test
    public void callsPostedBeforeTheStartRun() throws Exception {
        final SelectorLoop other = new SelectorLoop("other", running.faults);
        final CountDownLatch latch = new CountDownLatch(1);
        other.post(() -> latch.countDown());
        other.start();
        assertTrue(latch.await(20, TimeUnit.SECONDS));
        other.stop();
    }

    private Runnable note(final String name) {
        return () -> done.add(name);
    }

    private Callable<Boolean> has(final String name) {
        return () -> done.contains(name);
    }

    private static Runnable thrower(final Throwable fault) {
        return () -> {
            if (fault instanceof Error) {
                throw (Error) fault;
            }
            throw (RuntimeException) fault;
        };
    }
}
