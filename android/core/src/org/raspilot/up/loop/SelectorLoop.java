package org.raspilot.up.loop;

import java.io.IOException;

/** A loop on a thread of its own, with real sockets and real time. */
public final class SelectorLoop implements Loop, Network {
    /**
     * Makes a loop that is not started yet.
     *
     * @param name what its thread is called
     * @param faults hears of exceptions of what runs on the loop
     */
    public SelectorLoop(String name, FaultListener faults) {
    }

    /**
     * Starts the thread; calls that were posted before run then. A loop is started once.
     *
     * @throws IOException when the system gives no selector
     */
    public void start() throws IOException {
    }

    /**
     * Closes every socket and ends the thread within 1 s; nothing is told to any listener any more.
     * May be called on any thread, on the loop too, and twice; elsewhere than on the loop it waits
     * for the end of the thread.
     */
    public void stop() {
    }

    /** Returns how many calls threw; may be asked on any thread. */
    public long faults() {
        return 0;
    }

    /** Returns how often the loop woke; may be asked on any thread. */
    public long rounds() {
        return 0;
    }

    @Override
    public long nowMs() {
        return System.nanoTime() / 1000000L;
    }

    @Override
    public void post(Runnable call) {
    }

    @Override
    public Cancellable schedule(long delayMs, Runnable call) {
        throw new UnsupportedOperationException();
    }

    @Override
    public boolean isInLoop() {
        return false;
    }

    @Override
    public Network network() {
        return this;
    }

    @Override
    public TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener) {
        throw new UnsupportedOperationException();
    }

    @Override
    public UdpPort openUdp(UdpListener listener) throws IOException {
        throw new UnsupportedOperationException();
    }
}
