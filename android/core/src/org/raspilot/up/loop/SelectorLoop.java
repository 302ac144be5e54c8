package org.raspilot.up.loop;

import java.io.Closeable;
import java.io.IOException;
import java.nio.channels.SelectableChannel;
import java.nio.channels.SelectionKey;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.locks.LockSupport;
import org.raspilot.up.loop.NameLookup.SystemResolver;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.UdpPort.UdpListener;

/**
 * A loop on its own thread, with real sockets and real, monotonic time.
 *
 * <p>It sleeps in the system until a socket is ready, a timer falls due or a call is posted. A
 * selector that returns repeatedly without a reason, as some do after a connection broke, is
 * replaced by a new one.
 */
public final class SelectorLoop implements Loop, Network {
    private static final int STOP_MS = 1000;
    private static final int BYTES = 65536;
    /** Android 4 gives a thread 16 KB, too little for the deepest message that is read. */
    private static final long STACK_BYTES = 512 * 1024;

    private final Guard guard;
    private final Clock clock;
    private final SocketSelector sockets;
    private final NameLookup names;
    private final String name;
    private final byte[] bytes = new byte[BYTES];
    private final TimerQueue timers = new TimerQueue();
    private final Object lock = new Object();
    private final CallQueue posted = new CallQueue();
    private volatile Thread thread;
    private volatile boolean isStopped;
    private final AtomicLong rounds = new AtomicLong();

    /** Creates a loop on System.nanoTime(), which stops while a device sleeps. */
    public SelectorLoop(String name, FaultListener faults) {
        this(name, faults, () -> System.nanoTime());
    }

    /** Creates a loop that is not started; exceptions of calls on it go to {@code faults}. */
    public SelectorLoop(String name, FaultListener faults, Clock clock) {
        this(name, faults, clock, new SocketSelector(), new SystemResolver());
    }

    SelectorLoop(String name, FaultListener faults, Clock clock, SocketSelector sockets,
            NameLookup.Resolver resolver) {
        this.name = name;
        this.clock = clock;
        this.sockets = sockets;
        guard = new Guard(faults);
        names = new NameLookup(this, resolver, name + " names");
    }

    /**
     * Starts the thread; calls that were posted before run then.
     *
     * @throws IOException when the system gives no selector
     * @throws IllegalStateException when it was started or stopped before
     */
    public void start() throws IOException {
        synchronized (lock) {
            if (thread != null || isStopped) {
                throw new IllegalStateException("a loop is started once");
            }
            sockets.open();
            thread = new Thread(null, () -> work(), name, STACK_BYTES);
            thread.setDaemon(true);
            thread.start();
        }
    }

    /**
     * Closes every socket and ends the thread within 1 s; listeners are not called afterwards. May
     * be called on any thread, also on the loop, and repeatedly. On another thread it waits for the
     * end of the loop's thread, but at most that second if a call does not return.
     */
    public void stop() {
        final Thread running;
        synchronized (lock) {
            isStopped = true;
            running = thread;
            posted.close();
        }
        names.stop();
        if (running != null && !isInLoop()) {
            sockets.wakeup();
            try {
                running.join(STOP_MS);
            } catch (InterruptedException interruption) {
                Thread.currentThread().interrupt();
            }
        }
    }

    /** Returns the number of wake-ups; may be called on any thread. */
    public long rounds() {
        return rounds.get();
    }

    @Override
    public long nowMs() {
        return TimeUnit.NANOSECONDS.toMillis(clock.nowNs());
    }

    @Override
    public void post(Runnable call) {
        if (posted.add(call) && !isInLoop()) {
            sockets.wakeup();
        }
    }

    @Override
    public Cancellable schedule(long delayMs, Runnable call) {
        mustBeInLoop();
        final long delayNs = TimeUnit.MILLISECONDS.toNanos(Math.max(0, delayMs));
        // A delay of centuries must not run over into the past.
        return timers.add(clock.nowNs() + Math.min(delayNs, Long.MAX_VALUE / 2), call);
    }

    boolean isInLoop() {
        return Thread.currentThread() == thread;
    }

    @Override
    public Network network() {
        return this;
    }

    @Override
    public TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener) {
        mustBeInLoop();
        final TcpChannel channel = new TcpChannel(this, host, port, timeoutMs, listener);
        channel.open(names, host);
        return channel;
    }

    @Override
    public UdpPort openUdp(UdpListener listener) throws IOException {
        mustBeInLoop();
        final UdpChannel channel = new UdpChannel(this, names, listener);
        channel.open();
        return channel;
    }

    /** Returns the array that every channel reads into, one after the other. */
    byte[] bytes() {
        return bytes;
    }

    SelectionKey register(SelectableChannel channel, int operations, SelectorHandler ready)
            throws IOException {
        return sockets.register(channel, operations, ready);
    }

    /** Reports a fault that belongs to no call. */
    void report(Throwable fault) {
        guard.report(fault);
    }

    /** Closes; a socket that cannot be closed is reported as a fault. */
    void closeQuietly(Closeable channel) {
        try {
            channel.close();
        } catch (IOException error) {
            report(error);
        }
    }

    private void work() {
        try {
            while (!isStopped) {
                rounds.incrementAndGet();
                runPosted();
                runTimers();
                select();
            }
        } finally {
            closeAll();
        }
    }

    private void run(Runnable call) {
        if (!isStopped) {
            guard.run(call);
            // If the mark stayed set, the selector would return immediately every time.
            Thread.interrupted();
        }
    }

    private void runPosted() {
        for (Runnable call : posted.drain()) {
            sockets.hadReason();
            run(call);
        }
    }

    private void runTimers() {
        final long nowNs = clock.nowNs();
        final long mark = timers.mark();
        TimerQueue.Timer timer = timers.take(nowNs, mark);
        while (timer != null) {
            sockets.hadReason();
            run(timer.call);
            timer = timers.take(nowNs, mark);
        }
    }

    private void select() {
        try {
            for (SelectionKey key : sockets.await(waitMs(clock.nowNs()))) {
                handle(key);
            }
        } catch (IOException | RuntimeException error) {
            // Android's older selectors throw both (a key cancelled during the select). The thread
            // must survive that in flight.
            report(error);
            // Whatever the system's fault is, an immediate retry would only heat the phone.
            LockSupport.parkNanos(TimeUnit.MILLISECONDS.toNanos(10));
        }
    }

    private void handle(final SelectionKey key) {
        run(() -> {
            // A previous call may have closed it.
            if (key.isValid()) {
                ((SelectorHandler) key.attachment()).onReady(key);
            }
        });
    }

    /** Returns the maximum wait, rounded up; 0: none, -1: no limit. */
    private long waitMs(long nowNs) {
        if (isStopped || !posted.isEmpty()) {
            return 0;
        }
        final TimerQueue.Timer first = timers.first();
        if (first == null) {
            return -1;
        }
        final long waitNs = Math.max(0, first.time - nowNs);
        return (waitNs + 999999L) / 1000000L;
    }

    private void closeAll() {
        for (SelectorHandler ready : sockets.registered()) {
            ready.close();
        }
        try {
            sockets.close();
        } catch (IOException error) {
            report(error);
        }
    }

    private void mustBeInLoop() {
        if (!isInLoop()) {
            throw new IllegalStateException("only on the loop: post the call");
        }
    }
}
