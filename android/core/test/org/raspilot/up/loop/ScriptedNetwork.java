package org.raspilot.up.loop;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.UdpPort.UdpListener;

/** The network of a test: the test triggers every event of its connections. */
public final class ScriptedNetwork implements Network {
    public static final Charset UTF_8 = Charset.forName("UTF-8");
    public final List<Connection> connections = new ArrayList<>();
    public final List<Port> ports = new ArrayList<>();
    public boolean hasNoSockets;

    @Override
    public TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener) {
        final Connection connection = new Connection(host, port, timeoutMs, listener);
        connections.add(connection);
        return connection;
    }

    @Override
    public UdpPort openUdp(UdpListener listener) throws IOException {
        if (hasNoSockets) {
            throw new IOException("too many");
        }
        final Port port = new Port(listener);
        ports.add(port);
        return port;
    }

    public Connection newest() {
        return connections.get(connections.size() - 1);
    }

    /** One connection; {@code room} is how many bytes the system still takes. */
    public static final class Connection implements TcpConnection {
        public final String host;
        public final int port;
        public final int timeoutMs;
        public final TcpListener listener;
        public int room = Integer.MAX_VALUE;
        public boolean isClosed;
        private final ByteArrayOutputStream written = new ByteArrayOutputStream();
        private boolean isFull;

        Connection(String host, int port, int timeoutMs, TcpListener listener) {
            this.host = host;
            this.port = port;
            this.timeoutMs = timeoutMs;
            this.listener = listener;
        }

        @Override
        public int write(byte[] bytes, int offset, int length) {
            if (isClosed) {
                throw new AssertionError("written to after its end");
            }
            final int taken = Math.min(length, room);
            room -= taken;
            isFull = taken < length;
            written.write(bytes, offset, taken);
            return taken;
        }

        @Override
        public void close() {
            isClosed = true;
        }

        public void accept() {
            listener.onConnected();
        }

        public void say(String text) {
            final byte[] bytes = text.getBytes(UTF_8);
            listener.onBytes(bytes, bytes.length);
        }

        /** The connection ends, or fails to open. */
        public void end(String reason) {
            if (isClosed) {
                throw new AssertionError("ended by the other side already");
            }
            listener.onClosed("closed", reason);
        }

        /** The system accepts that many more bytes. */
        public void makeRoom(int bytes) {
            room = bytes;
            if (isFull && room > 0) {
                isFull = false;
                listener.onWritable();
            }
        }

        /** Returns the bytes written since the last call. */
        public String written() {
            return new String(writtenBytes(), UTF_8);
        }

        public byte[] writtenBytes() {
            final byte[] bytes = written.toByteArray();
            written.reset();
            return bytes;
        }
    }

    public static final class Port implements UdpPort {
        public final UdpListener listener;
        public final List<String> sent = new ArrayList<>();
        public boolean isClosed;
        public boolean hasNoNetwork;

        Port(UdpListener listener) {
            this.listener = listener;
        }

        @Override
        public boolean send(byte[] datagram, String host, int port) {
            if (isClosed) {
                throw new AssertionError("sent with after its end");
            }
            if (!hasNoNetwork) {
                sent.add(new String(datagram, UTF_8) + " -> " + host + ":" + port);
            }
            return !hasNoNetwork;
        }

        @Override
        public void close() {
            isClosed = true;
        }

        public void come(String text, String host, int port) {
            final byte[] bytes = text.getBytes(UTF_8);
            listener.onDatagram(bytes, bytes.length, host, port);
        }
    }
}
