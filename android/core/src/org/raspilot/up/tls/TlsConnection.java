package org.raspilot.up.tls;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.security.GeneralSecurityException;
import java.util.concurrent.Executor;
import javax.net.ssl.SSLEngine;
import javax.net.ssl.SSLEngineResult.HandshakeStatus;
import javax.net.ssl.SSLEngineResult.Status;
import javax.net.ssl.SSLEngineResult;
import javax.net.ssl.SSLException;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;

/**
 * TLS on a TCP connection: its listener learns of the connection after the handshake, and sends and
 * receives plain data. What takes long runs on another thread.
 *
 * <p>Only on the loop. Source: docs/security.md, "TLS".
 */
public final class TlsConnection implements TcpConnection, TcpListener {
    /** How long the handshake may take, ms. */
    static final int HANDSHAKE_MS = 5000;

    /** More than the longest record. */
    private static final int RECORD_BYTES = 36864;
    /** Most that may wait for the engine, which is busy on the other thread. */
    private static final int MAX_WAITING_BYTES = 1 << 18;
    private static final byte ALERT = 21;
    private static final byte HANDSHAKE = 22;

    private final Loop loop;
    private final Executor others;
    private final TlsIdentity identity;
    private final ServerTrust trust;
    private final String host;
    private final int port;
    private final TcpListener listener;
    private final ByteBuffer received = ByteBuffer.allocate(RECORD_BYTES);
    private final ByteBuffer outgoing = ByteBuffer.allocate(RECORD_BYTES);
    private ByteBuffer incoming = ByteBuffer.allocate(0);
    private TcpConnection tcp;
    private SSLEngine engine;
    private Cancellable limit = Cancellable.DONE;
    private boolean isHeard;
    private boolean isBusy;
    private boolean isOpen;
    private boolean isClosed;
    /** Whether the listener waits for room. */
    private boolean isFull;

    TlsConnection(Loop loop, Executor others, TlsIdentity identity, String host, int port,
            TcpListener listener) {
        this.loop = loop;
        this.others = others;
        this.identity = identity;
        this.host = host.indexOf('%') < 0 ? host : host.substring(0, host.indexOf('%'));
        this.port = port;
        this.listener = listener;
        trust = identity.trust(this.host);
        outgoing.flip();
    }

    /**
     * Connects as {@link org.raspilot.up.loop.Network#connectTcp} does, by TLS if there is an
     * identity: a server without TLS, or one that is not trusted, ends the connection with a code.
     *
     * @param identity null: plain TCP
     */
    public static TcpConnection open(Loop loop, TlsIdentity identity, String host, int port,
            int timeoutMs, TcpListener listener) {
        if (identity == null) {
            return loop.network().connectTcp(host, port, timeoutMs, listener);
        }
        return new TlsConnection(loop, call -> {
            final Thread thread = new Thread(call, "up tls");
            thread.setDaemon(true);
            thread.start();
        }, identity, host, port, listener).connect(timeoutMs);
    }

    TlsConnection connect(int timeoutMs) {
        tcp = loop.network().connectTcp(host, port, timeoutMs, this);
        return this;
    }

    /** Encrypts at most what the system accepts, and one record that waits for it. */
    @Override
    public int write(byte[] bytes, int offset, int length) {
        final ByteBuffer plain = ByteBuffer.wrap(bytes, offset, length);
        if (!isOpen || isClosed) {
            return 0;
        }
        try {
            while (plain.hasRemaining() && !isBusy && wrap(plain)) {
                continue;
            }
        } catch (SSLException fault) {
            // As TCP: a writer is not called back.
            loop.post(() -> fail(fault));
        }
        isFull = plain.hasRemaining();
        return length - plain.remaining();
    }

    @Override
    public void close() {
        if (isClosed) {
            return;
        }
        isClosed = true;
        limit.cancel();
        if (engine != null && !isBusy) {
            engine.closeOutbound();
            try {
                // The notice of the end, or the alert that says why.
                wrap(ByteBuffer.allocate(0));
            } catch (SSLException untold) {
                // The peer learns of the end by that of TCP.
            }
        }
        tcp.close();
    }

    @Override
    public void onConnected() {
        limit = loop.schedule(HANDSHAKE_MS, () -> fail(new TlsException("tls_timeout",
                "no handshake within " + HANDSHAKE_MS / 1000 + " s")));
        aside(() -> {
            final SSLEngine made = identity.engine(host, port, trust);
            made.beginHandshake();
            engine = made;
        });
    }

    @Override
    public void onBytes(byte[] bytes, int length) {
        if (!isHeard && bytes[0] != HANDSHAKE && bytes[0] != ALERT) {
            fail(new TlsException("tls_peer_plain", "it does not speak TLS on this port"));
            return;
        }
        isHeard = true;
        final ByteBuffer all = ByteBuffer.allocate(incoming.remaining() + length);
        all.put(incoming).put(bytes, 0, length).flip();
        incoming = all;
        if (incoming.remaining() > MAX_WAITING_BYTES) {
            fail(new TlsException("tls_failed", "it sends too much"));
        } else {
            proceed();
        }
    }

    @Override
    public void onWritable() {
        proceed();
    }

    @Override
    public void onClosed(String code, String reason) {
        if (isOpen || limit == Cancellable.DONE) {
            end(code, reason);
        } else {
            fail(new TlsException("tls_closed", "it closed the connection in the handshake"));
        }
    }

    /** Does what the engine wants, as far as data and room are there. */
    private void proceed() {
        boolean isDone = false;
        try {
            while (!isClosed && !isBusy && step()) {
                continue;
            }
            isDone = true;
        } catch (SSLException fault) {
            isDone = true;
            fail(fault);
        } finally {
            if (!isDone) {
                // The listener threw: it gets the rest all the same.
                loop.post(() -> proceed());
            }
        }
        if (isFull && !isClosed && !isBusy && flush()) {
            isFull = false;
            listener.onWritable();
        }
    }

    /** Returns whether there may be more to do. */
    private boolean step() throws SSLException {
        final HandshakeStatus next = engine.getHandshakeStatus();
        if (next == HandshakeStatus.NEED_TASK) {
            aside(() -> {
                for (Runnable task = engine.getDelegatedTask(); task != null;
                        task = engine.getDelegatedTask()) {
                    task.run();
                }
            });
            return false;
        }
        if (next == HandshakeStatus.NEED_WRAP) {
            return wrap(ByteBuffer.allocate(0));
        }
        if (next != HandshakeStatus.NEED_UNWRAP && !isOpen) {
            isOpen = true;
            limit.cancel();
            listener.onConnected();
            return true;
        }
        flush();
        return unwrap();
    }

    private boolean unwrap() throws SSLException {
        if (!incoming.hasRemaining()) {
            return false;
        }
        received.clear();
        final SSLEngineResult result = engine.unwrap(incoming, received);
        if (result.getStatus() == Status.CLOSED) {
            end("closed", host + ":" + port + " closed the connection");
            return false;
        }
        received.flip();
        if (received.hasRemaining()) {
            listener.onBytes(received.array(), received.remaining());
        }
        return result.bytesConsumed() > 0
                || result.getHandshakeStatus() == HandshakeStatus.NEED_TASK
                || result.getHandshakeStatus() == HandshakeStatus.NEED_WRAP;
    }

    /** Encrypts one record, unless an earlier one waits; returns whether it did. */
    private boolean wrap(ByteBuffer plain) throws SSLException {
        if (!flush()) {
            return false;
        }
        outgoing.clear();
        final SSLEngineResult result;
        try {
            result = engine.wrap(plain, outgoing);
        } finally {
            outgoing.flip();
        }
        flush();
        return result.bytesProduced() > 0;
    }

    /** Returns whether the system has accepted all that was encrypted. */
    private boolean flush() {
        if (outgoing.hasRemaining()) {
            outgoing.position(outgoing.position() + tcp.write(outgoing.array(),
                    outgoing.position(), outgoing.remaining()));
        }
        return !outgoing.hasRemaining();
    }

    /** Runs a long step on another thread, then continues here. */
    private void aside(Step step) {
        isBusy = true;
        others.execute(() -> {
            Exception fault = null;
            try {
                step.run();
            } catch (GeneralSecurityException | IOException | RuntimeException found) {
                fault = found;
            }
            final Exception found = fault;
            loop.post(() -> {
                isBusy = false;
                if (found != null) {
                    fail(found);
                } else {
                    proceed();
                }
            });
        });
    }

    private void fail(Exception fault) {
        final TlsException found = trust.fault() != null ? trust.fault() : TlsException.of(fault);
        end(found.code, "no TLS with " + host + ":" + port + ": " + found.getMessage());
    }

    private void end(String code, String reason) {
        if (!isClosed) {
            close();
            listener.onClosed(code, reason);
        }
    }

    private interface Step {
        void run() throws GeneralSecurityException, IOException;
    }
}
