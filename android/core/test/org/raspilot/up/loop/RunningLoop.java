package org.raspilot.up.loop;

import java.io.IOException;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.FutureTask;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicLong;
import org.junit.rules.ExternalResource;

/** A started {@link SelectorLoop} of one test: runs calls on it, and waits for what must come. */
public final class RunningLoop extends ExternalResource {
    private static final int MAX_WAIT_S = 20;
    private static final int LOOK_MS = 2;

    public final Faults faults = new Faults();
    public final SelectorLoop loop;
    private final AtomicLong sleptNs = new AtomicLong();
    private final Clock clock = () -> System.nanoTime() + sleptNs.get();

    public RunningLoop() {
        loop = new SelectorLoop("test loop", faults, clock);
    }

    public RunningLoop(SocketSelector sockets, NameLookup.Resolver resolver) {
        loop = new SelectorLoop("test loop", faults, clock, sockets, resolver);
    }

    @Override
    protected void before() throws IOException {
        loop.start();
    }

    @Override
    protected void after() {
        loop.stop();
    }

    /** Runs a call on the loop and returns what it returns; throws what it throws. */
    public <T> T call(Callable<T> call) {
        final FutureTask<T> task = new FutureTask<>(call);
        loop.post(task);
        try {
            return task.get(MAX_WAIT_S, TimeUnit.SECONDS);
        } catch (ExecutionException error) {
            throw new AssertionError(error.getCause());
        } catch (InterruptedException error) {
            throw new AssertionError(error);
        } catch (TimeoutException error) {
            throw new AssertionError("the loop did not come to it", error);
        }
    }

    /** Waits until a condition, evaluated on the loop, holds; fails after a timeout. */
    public void await(final String what, final Callable<Boolean> condition) {
        final CountDownLatch latch = new CountDownLatch(1);
        loop.post(new Runnable() {
            @Override
            public void run() {
                try {
                    if (condition.call()) {
                        latch.countDown();
                    } else if (latch.getCount() > 0) {
                        loop.schedule(LOOK_MS, this);
                    }
                } catch (Exception error) {
                    throw new AssertionError(error);
                }
            }
        });
        wait(latch, "never came: " + what);
    }

    /** The device sleeps for that time: only its clock advances. */
    public void sleep(long forMs) {
        sleptNs.addAndGet(TimeUnit.MILLISECONDS.toNanos(forMs));
    }

    /** Returns a clock by which another loop may live. */
    public Clock clock() {
        return clock;
    }

    /** Waits until so much of the loop's own time has passed. */
    public void pass(final int delayMs) {
        final CountDownLatch latch = new CountDownLatch(1);
        loop.post(() -> loop.schedule(delayMs, () -> latch.countDown()));
        wait(latch, "time stands still");
    }

    private static void wait(CountDownLatch latch, String complaint) {
        try {
            if (!latch.await(MAX_WAIT_S, TimeUnit.SECONDS)) {
                throw new AssertionError(complaint);
            }
        } catch (InterruptedException error) {
            throw new AssertionError(error);
        }
    }
}
