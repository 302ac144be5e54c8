package org.raspilot.up.loop;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.nio.ByteBuffer;
import java.nio.channels.SelectionKey;
import java.nio.channels.SocketChannel;
import org.raspilot.up.loop.TcpConnection.TcpListener;

/** One TCP connection of a {@link SelectorLoop}: looks up, connects, reads, writes. */
final class TcpChannel implements TcpConnection, SelectorHandler, NameLookup.Asker {
    /**
     * Small, so that a stalled link holds little old data when it recovers. Linux doubles it and
     * counts its own overhead against it.
     */
    static final int SEND_BUFFER_BYTES = 8192;
    private static final int MAX_FINAL_READS = 8;

    private enum State { CONNECTING, OPEN, BROKEN, CLOSED }

    private final SelectorLoop loop;
    private final String peer;
    private final int port;
    private final int timeoutMs;
    private final long endMs;
    private final TcpListener listener;
    private State state = State.CONNECTING;
    private Cancellable limit = Cancellable.DONE;
    private InetAddress[] addresses = new InetAddress[0];
    private int tried;
    private SocketChannel channel;
    private SelectionKey key;

    TcpChannel(SelectorLoop loop, String host, int port, int timeoutMs, TcpListener listener) {
        this.loop = loop;
        this.port = port;
        this.timeoutMs = timeoutMs;
        this.listener = listener;
        peer = host + ":" + port;
        endMs = loop.nowMs() + timeoutMs;
    }

    void open(NameLookup names, String host) {
        if (port < 1 || port > 65535) {
            onUnknown("no port: " + port);
            return;
        }
        limit(timeoutMs, "the name " + host + " was not found within " + timeoutMs + " ms");
        names.resolve(host, this);
    }

    @Override
    public void onAddresses(InetAddress[] found) {
        if (state == State.CONNECTING) {
            addresses = found;
            connectNext("no address");
        }
    }

    @Override
    public void onUnknown(String reason) {
        if (state == State.CONNECTING) {
            failLater(reason);
        }
    }

    @Override
    public int write(byte[] bytes, int offset, int length) {
        if (state != State.OPEN) {
            return 0;
        }
        try {
            final int taken = channel.write(ByteBuffer.wrap(bytes, offset, length));
            if (taken < length) {
                key.interestOps(SelectionKey.OP_READ | SelectionKey.OP_WRITE);
            }
            return taken;
        } catch (IOException error) {
            state = State.BROKEN;
            final String reason = broke(error);
            loop.post(() -> readTheRest(reason));
            return 0;
        }
    }

    @Override
    public void close() {
        state = State.CLOSED;
        limit.cancel();
        closeChannel();
    }

    @Override
    public void onMoved(SelectionKey moved) {
        key = moved;
    }

    @Override
    public void onReady(SelectionKey ready) {
        if (state == State.CONNECTING) {
            finish();
            return;
        }
        if (ready.isReadable()) {
            read();
        }
        if (state == State.OPEN && ready.isWritable()) {
            key.interestOps(SelectionKey.OP_READ);
            listener.onWritable();
        }
    }

    /** Tries the next address; with none left, ends for {@code reason}. */
    private void connectNext(String reason) {
        closeChannel();
        if (tried == addresses.length) {
            failLater(reason);
            return;
        }
        final int left = addresses.length - tried;
        // One address that swallows everything must leave time for the others.
        limit((endMs - loop.nowMs()) / left, "no answer from " + peer + " within " + timeoutMs
                + " ms");
        final InetSocketAddress address = new InetSocketAddress(addresses[tried++], port);
        final boolean isConnected;
        try {
            channel = SocketChannel.open();
            channel.configureBlocking(false);
            final Socket socket = channel.socket();
            socket.setTcpNoDelay(true);
            socket.setKeepAlive(true);
            socket.setSendBufferSize(SEND_BUFFER_BYTES);
            isConnected = channel.connect(address);
            key = loop.register(channel,
                    isConnected ? SelectionKey.OP_READ : SelectionKey.OP_CONNECT, this);
        } catch (IOException | RuntimeException error) {
            // Android throws SecurityException without the permission to use the network.
            connectNext(refused(error));
            return;
        }
        if (isConnected) {
            connected();
        }
    }

    private void finish() {
        try {
            if (!channel.finishConnect()) {
                return;
            }
            final Socket socket = channel.socket();
            // Some systems do not know the local address yet: it may be null.
            if (socket.getRemoteSocketAddress().equals(socket.getLocalSocketAddress())) {
                // On loopback a connection to an unused port may by chance connect to itself.
                connectNext("no connection to " + peer + ": nothing listens there");
                return;
            }
        } catch (IOException error) {
            connectNext(refused(error));
            return;
        }
        key.interestOps(SelectionKey.OP_READ);
        connected();
    }

    private void connected() {
        limit.cancel();
        state = State.OPEN;
        listener.onConnected();
    }

    private boolean read() {
        final byte[] bytes = loop.bytes();
        final int length;
        try {
            length = channel.read(ByteBuffer.wrap(bytes));
        } catch (IOException error) {
            fail(broke(error));
            return false;
        }
        if (length < 0) {
            fail(peer + " closed the connection");
        } else if (length > 0) {
            listener.onBytes(bytes, length);
        }
        return length > 0;
    }

    /** Data that the peer sent before it hung up arrived before the write failed: deliver it. */
    private void readTheRest(String reason) {
        int reads = 0;
        while (state == State.BROKEN && reads < MAX_FINAL_READS && read()) {
            reads++;
        }
        if (state == State.BROKEN) {
            fail(reason);
        }
    }

    private void failLater(final String reason) {
        limit.cancel();
        state = State.BROKEN;
        loop.post(() -> fail(reason));
    }

    private void fail(String reason) {
        if (state != State.CLOSED) {
            close();
            listener.onClosed("closed", reason);
        }
    }

    private void limit(long delayMs, final String reason) {
        limit.cancel();
        limit = loop.schedule(delayMs, () -> connectNext(reason));
    }

    private void closeChannel() {
        if (channel != null) {
            loop.closeQuietly(channel);
            channel = null;
        }
    }

    private String refused(Exception error) {
        return "no connection to " + peer + ": " + words(error);
    }

    private String broke(IOException error) {
        return "the connection to " + peer + " broke: " + words(error);
    }

    private static String words(Exception error) {
        final String words = error.getMessage();
        return words == null ? error.getClass().getSimpleName() : words;
    }
}
