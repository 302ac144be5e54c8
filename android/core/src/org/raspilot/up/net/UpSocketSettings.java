package org.raspilot.up.net;

import org.raspilot.up.tls.TlsIdentity;

/** How an {@link UpSocket} behaves; immutable, each {@code with} returns another. Times in ms. */
public final class UpSocketSettings {
    public static final int MAX_QUEUE_BYTES = 65536;

    /** Whether raw frames go to the orientation port, instead of lines to the other. */
    public final boolean isRaw;
    public final int connectTimeoutMs;
    /** The period of the heartbeat; 0: none. */
    public final int heartbeatMs;
    /** How long the peer may accept no waiting data; 0: no limit. */
    public final int stallLimitMs;
    /** The wait after the first failure. */
    public final int initialRetryMs;
    public final int maxRetryMs;
    /** The certificates of TLS; null: plain TCP. */
    public final TlsIdentity tls;

    UpSocketSettings(boolean isRaw, int connectTimeoutMs, int heartbeatMs, int stallLimitMs,
            int initialRetryMs, int maxRetryMs, TlsIdentity tls) {
        this.isRaw = isRaw;
        this.connectTimeoutMs = connectTimeoutMs;
        this.heartbeatMs = heartbeatMs;
        this.stallLimitMs = stallLimitMs;
        this.initialRetryMs = initialRetryMs;
        this.maxRetryMs = maxRetryMs;
        this.tls = tls;
    }

    /**
     * Returns lines to the General Message port: 2 s to connect, retries after 0.5 to 2 s, no
     * heartbeat, 3 s in which the peer may take nothing of what waits.
     */
    public static UpSocketSettings lines() {
        return new UpSocketSettings(false, 2000, 0, 3000, 500, 2000, null);
    }

    /** Returns raw frames to the orientation port; otherwise as {@link #lines}. */
    public static UpSocketSettings raw() {
        return new UpSocketSettings(true, 2000, 0, 3000, 500, 2000, null);
    }

    /** Returns these settings with a timeout of each attempt, including name lookup. */
    public UpSocketSettings withConnectTimeoutMs(int timeoutMs) {
        return new UpSocketSettings(isRaw, timeoutMs, heartbeatMs, stallLimitMs,
                initialRetryMs, maxRetryMs, tls);
    }

    /** Returns these with an empty line after each {@code periodMs} of own silence; 0: none. */
    public UpSocketSettings withHeartbeatMs(int periodMs) {
        return new UpSocketSettings(isRaw, connectTimeoutMs, periodMs, stallLimitMs,
                initialRetryMs, maxRetryMs, tls);
    }

    /** Returns these with TLS alone, to a server that these certificates accept; null: plain. */
    public UpSocketSettings withTls(TlsIdentity identity) {
        return new UpSocketSettings(isRaw, connectTimeoutMs, heartbeatMs, stallLimitMs,
                initialRetryMs, maxRetryMs, identity);
    }
}
