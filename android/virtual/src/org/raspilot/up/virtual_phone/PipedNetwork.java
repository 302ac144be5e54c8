package org.raspilot.up.virtual_phone;

import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.Network;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.loop.UdpPort.UdpListener;
import org.raspilot.up.loop.UdpPort;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** A network behind a pipe: a simulator opens, writes and closes for it. */
final class PipedNetwork implements Network {
    /** How bytes become text: each byte one character. */
    static final Charset BYTES = Charset.forName("ISO-8859-1");

    private final Map<Long, PipedConnection> connections = new HashMap<>();
    private final Map<Long, PipedUdpPort> ports = new HashMap<>();
    private List<Object> toDo = new ArrayList<>();
    private long lastId;

    @Override
    public TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener) {
        PipedConnection connection = new PipedConnection(this, ++lastId, listener);
        connections.put(lastId, connection);
        request("connect", lastId, host, (long) port, (long) timeoutMs);
        return connection;
    }

    @Override
    public UdpPort openUdp(UdpListener listener) {
        PipedUdpPort port = new PipedUdpPort(this, ++lastId, listener);
        ports.put(lastId, port);
        request("open", lastId);
        return port;
    }

    /** Sends a request to the simulator. */
    void request(Object... words) {
        toDo.add(Arrays.asList(words));
    }

    /** Discards a connection or a socket. */
    void remove(long id) {
        connections.remove(id);
        ports.remove(id);
    }

    /** Returns and clears the requests to the simulator. */
    List<Object> takeRequests() {
        List<Object> taken = toDo;
        toDo = new ArrayList<>();
        return taken;
    }

    /**
     * Posts every event to the loop, each as its own guarded call.
     *
     * @throws OptionException when one is invalid (a sentence); those before it are run
     */
    void deliver(Loop loop, List<?> events) throws OptionException {
        for (Object each : events) {
            try {
                loop.post(happening((List<?>) each));
            } catch (ClassCastException error) {
                throw new OptionException("net: invalid event: " + each);
            } catch (IndexOutOfBoundsException error) {
                throw new OptionException("net: an event is too short: " + each);
            }
        }
    }

    private Runnable happening(List<?> words) throws OptionException {
        final String kind = (String) words.get(0);
        final long id = (Long) words.get(1);
        final Object first = words.size() > 2 ? words.get(2) : null;
        if ("datagram".equals(kind)) {
            final byte[] datagram = ((String) first).getBytes(BYTES);
            final String host = (String) words.get(3);
            final int port = ((Long) words.get(4)).intValue();
            return () -> {
                PipedUdpPort target = ports.get(id);
                if (target != null) {
                    target.deliver(datagram, host, port);
                }
            };
        }
        final PipedConnection.Event event = PipedConnection.parse(kind, first);
        return () -> {
            PipedConnection connection = connections.get(id);
            // Connections closed before the event are not called.
            if (connection != null) {
                event.apply(connection);
            }
        };
    }

    /** A UDP socket of a simulator. */
    static final class PipedUdpPort implements UdpPort {
        private final PipedNetwork network;
        private final long id;
        private final UdpListener listener;
        private boolean isClosed;

        /** Takes its number on the pipe. */
        PipedUdpPort(PipedNetwork network, long id, UdpListener listener) {
            this.network = network;
            this.id = id;
            this.listener = listener;
        }

        @Override
        public boolean send(byte[] datagram, String host, int port) {
            if (isClosed) {
                return false;
            }
            network.request("send", id, new String(datagram, PipedNetwork.BYTES), host,
                    (long) port);
            return true;
        }

        @Override
        public void close() {
            if (!isClosed) {
                isClosed = true;
                network.remove(id);
                network.request("shut", id);
            }
        }

        void deliver(byte[] datagram, String host, int port) {
            listener.onDatagram(datagram, datagram.length, host, port);
        }
    }
}
