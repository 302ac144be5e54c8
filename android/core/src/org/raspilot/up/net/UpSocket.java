package org.raspilot.up.net;

import java.util.Random;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;
import org.raspilot.up.tls.TlsConnection;

/**
 * Keeps one connection to a peer: finds it, connects, and reconnects after a loss.
 *
 * <p>Nothing is carried over to the next connection: neither queued messages nor a partial received
 * line. Only on the loop; the listener may call every method. Source: docs/protocols.md 3, 4 and 9.
 */
public final class UpSocket {
    private static final byte LF = '\n';

    private final Loop loop;
    private final EndpointDiscovery discovery;
    private final UpSocketListener listener;
    private final UpSocketSettings settings;
    private final BackOff backOff;
    private final ConnectionWatchdog watch;
    private final LineDispatcher lines;
    private final SendQueue queue;
    private UpSocketStatus status =
            new UpSocketStatus(UpSocketStatus.State.STOPPED, null, "stopped", "not started");
    private Endpoint place;
    private Attempt current;
    private Cancellable retry = Cancellable.DONE;
    private long connects;

    /** Creates a socket that is not started; {@code random}, seeded, varies the retry waits. */
    public UpSocket(Loop loop, EndpointDiscovery discovery, UpSocketListener listener,
            UpSocketSettings settings, Random random) {
        this.loop = loop;
        this.discovery = discovery;
        this.listener = listener;
        this.settings = settings;
        queue = new SendQueue(settings.isRaw);
        backOff = new BackOff(settings.initialRetryMs, settings.maxRetryMs, random);
        lines = new LineDispatcher(loop, line -> listener.onReceived(line, line.length));
        watch = new ConnectionWatchdog(loop, settings, () -> beat(), () -> drop("stalled",
                current.peer + " took nothing for " + settings.stallLimitMs + " ms"));
    }

    /** Starts to connect; no effect when started already. */
    public void start() {
        if (status.state == UpSocketStatus.State.STOPPED) {
            backOff.reset();
            attempt();
        }
    }

    /** Closes until the next {@link #start}; {@code onLost} is called if it was connected. */
    public void stop() {
        if (status.state != UpSocketStatus.State.STOPPED) {
            final boolean wasConnected = end();
            setState(UpSocketStatus.State.STOPPED, "stopped", "stopped");
            if (wasConnected) {
                listener.onLost("stopped");
            }
        }
    }

    /**
     * Retries immediately instead of after the wait, as when the phone's network is back; an
     * attempt older than the shortest wait is restarted. No effect while connected.
     */
    public void reconnectNow() {
        final UpSocketStatus.State state = status.state;
        final boolean isTrying = current != null && !isConnected()
                && loop.nowMs() - current.beganMs >= settings.initialRetryMs;
        if (isTrying || state == UpSocketStatus.State.WAITING) {
            end();
            backOff.reset();
            attempt();
        }
    }

    /** Ends this connection, or attempt, and retries; the code is the status's. */
    public void drop(String code, String reason) {
        if (current == null) {
            return;
        }
        final long nowMs = loop.nowMs();
        long tookMs = nowMs - current.beganMs;
        if (isConnected()) {
            tookMs = 0;
            if (nowMs - current.connectedMs >= settings.maxRetryMs) {
                // Not earlier: the wait must grow for a peer that always hangs up immediately.
                backOff.reset();
            }
        }
        final boolean wasConnected = end();
        retry = loop.schedule(backOff.nextWaitMs(tookMs), () -> attempt());
        setState(UpSocketStatus.State.WAITING, code, reason + "; trying again");
        if (wasConnected) {
            listener.onLost(reason);
        }
    }

    /**
     * Sends a line (its LF is added when it has none) or a frame, in order, and before what waits
     * for {@link #sendNewest}.
     *
     * @return false when not connected, when 64 KiB wait already, and for a line of more than
     *     16 KiB: nothing is kept for later
     */
    public boolean send(byte[] bytes) {
        return flushIf(isConnected() && queue.add(bytes));
    }

    /**
     * Sends a line or a frame in place of the one that still waits under {@code key}.
     *
     * @return false when not connected, when 64 KiB wait under other keys, and for a line of more
     *     than 16 KiB: nothing is kept for later
     */
    public boolean sendNewest(Object key, byte[] bytes) {
        return flushIf(isConnected() && queue.replace(key, bytes));
    }

    public boolean isConnected() {
        return status.isConnected();
    }

    public UpSocketStatus status() {
        return status;
    }

    public long connects() {
        return connects;
    }

    private void attempt() {
        final Attempt attempt = new Attempt();
        current = attempt;
        setState(UpSocketStatus.State.FINDING, "", "looking for the peer");
        boolean isBegun = false;
        try {
            attempt.search = discovery.find(attempt);
            isBegun = true;
        } finally {
            if (!isBegun && current == attempt) {
                // A finder that throws is called again too.
                drop("search_failed", "the search failed");
            }
        }
    }

    /** Ends the current attempt or connection; returns whether it was a connection. */
    private boolean end() {
        final boolean wasConnected = isConnected();
        retry.cancel();
        watch.stop();
        lines.end();
        queue.clear();
        if (current != null) {
            final Attempt ended = current;
            current = null;
            ended.close();
        }
        return wasConnected;
    }

    private void setState(UpSocketStatus.State state, String code, String sentence) {
        status = new UpSocketStatus(state, place, code, sentence);
        // Posted, because a listener may throw, and may stop this in the middle of a change.
        loop.post(() -> listener.onStatus());
    }

    private boolean flushIf(boolean isTaken) {
        if (isTaken) {
            flush();
        }
        return isTaken;
    }

    private void flush() {
        final int bytes = queue.flush(current.connection);
        watch.onWritten(bytes, !queue.isEmpty());
    }

    /** What waits is a sign of life itself, and a line must not be broken. */
    private void beat() {
        if (queue.isEmpty()) {
            watch.onWritten(current.connection.write(new byte[] {LF}, 0, 1), false);
        }
    }

    /** One attempt and, if it succeeds, its connection; ignores events once replaced. */
    private final class Attempt implements DiscoveryListener, TcpListener {
        private final long beganMs = loop.nowMs();
        private long connectedMs;
        private String peer = "the peer";
        private Cancellable search;
        private TcpConnection connection;

        void close() {
            if (search != null) {
                search.cancel();
            }
            if (connection != null) {
                connection.close();
            }
        }

        @Override
        public void onFound(Endpoint found) {
            if (current != this) {
                return;
            }
            place = found;
            final int port = settings.isRaw ? found.orientationPort : found.generalPort;
            peer = found.host + ":" + port;
            setState(UpSocketStatus.State.CONNECTING, "", "connecting to " + peer);
            connection = TlsConnection.open(loop, settings.tls, found.host, port,
                    settings.connectTimeoutMs, this);
        }

        @Override
        public void onNotFound(String code, String reason) {
            if (current == this) {
                drop(code, reason);
            }
        }

        @Override
        public void onConnected() {
            connectedMs = loop.nowMs();
            connects++;
            lines.begin(this);
            setState(UpSocketStatus.State.CONNECTED, "", "connected to " + peer);
            watch.start();
            listener.onConnected();
        }

        @Override
        public void onBytes(byte[] bytes, int length) {
            if (settings.isRaw) {
                listener.onReceived(bytes, length);
            } else {
                lines.feed(bytes, length);
            }
        }

        @Override
        public void onWritable() {
            flush();
        }

        @Override
        public void onClosed(String code, String reason) {
            drop(code, reason);
        }
    }
}
