package org.raspilot.up.loop;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.nio.channels.DatagramChannel;
import java.nio.channels.SelectionKey;
import java.util.HashMap;
import java.util.Map;
import org.raspilot.up.loop.UdpPort.UdpListener;

/** One UDP socket of a {@link SelectorLoop}. */
final class UdpChannel implements UdpPort, SelectorHandler {
    private static final long NAME_LIFE_MS = 60000;
    /** An unknown name is looked up again after this time, not for each datagram. */
    private static final long NEXT_LOOK_MS = 2000;
    private static final int MAX_NAMES = 64;
    private static final int READS_A_ROUND = 16;

    private final SelectorLoop loop;
    private final NameLookup names;
    private final UdpListener listener;
    private final Map<String, Name> known = new HashMap<>();
    private DatagramChannel channel;
    private boolean isClosed;

    UdpChannel(SelectorLoop loop, NameLookup names, UdpListener listener) {
        this.loop = loop;
        this.names = names;
        this.listener = listener;
    }

    /** Opens the socket on any port. */
    void open() throws IOException {
        channel = DatagramChannel.open();
        try {
            channel.configureBlocking(false);
            channel.socket().setBroadcast(true);
            channel.socket().bind(new InetSocketAddress(0));
            loop.register(channel, SelectionKey.OP_READ, this);
        } catch (IOException error) {
            closeChannel();
            throw error;
        }
    }

    @Override
    public boolean send(byte[] datagram, String host, int port) {
        if (isClosed || port < 1 || port > 65535) {
            return false;
        }
        final InetAddress address = address(host);
        if (address == null) {
            return false;
        }
        try {
            if (channel == null) {
                open();
            }
            final ByteBuffer buffer = ByteBuffer.wrap(datagram);
            // 0: the system has no room now. The next datagram will be newer.
            return channel.send(buffer, new InetSocketAddress(address, port)) > 0
                    || datagram.length == 0;
        } catch (IOException | SecurityException error) {
            return false; // No network, as when a phone changes it: reported to the caller.
        }
    }

    @Override
    public void close() {
        isClosed = true;
        closeChannel();
    }

    @Override
    public void onMoved(SelectionKey moved) {
        // Its key is not used: it is ready for nothing but reading.
    }

    @Override
    public void onReady(SelectionKey ready) {
        int reads = 0;
        while (channel != null && reads < READS_A_ROUND && receive()) {
            reads++;
        }
    }

    private boolean receive() {
        final byte[] bytes = loop.bytes();
        final ByteBuffer buffer = ByteBuffer.wrap(bytes);
        final InetSocketAddress source;
        try {
            source = (InetSocketAddress) channel.receive(buffer);
        } catch (IOException error) {
            // A socket with a read error would stay ready; the next send opens another.
            closeChannel();
            loop.report(error);
            return false;
        }
        if (source == null) {
            return false;
        }
        listener.onDatagram(bytes, buffer.position(), source.getAddress().getHostAddress(),
                source.getPort());
        return true;
    }

    /** Returns a host's address, or null if unknown so far. */
    private InetAddress address(final String host) {
        Name name = known.get(host);
        if (name == null) {
            if (known.size() >= MAX_NAMES) {
                known.clear();
            }
            name = new Name();
            name.address = NameLookup.numeric(host);
            name.nextLookMs = name.address == null ? loop.nowMs() : Long.MAX_VALUE;
            known.put(host, name);
        }
        if (!name.isAsked && loop.nowMs() >= name.nextLookMs) {
            name.isAsked = true;
            names.resolve(host, name);
        }
        return name.address;
    }

    private void closeChannel() {
        if (channel != null) {
            loop.closeQuietly(channel);
            channel = null;
        }
    }

    private final class Name implements NameLookup.Asker {
        private InetAddress address;
        private long nextLookMs;
        private boolean isAsked;

        @Override
        public void onAddresses(InetAddress[] addresses) {
            isAsked = false;
            address = addresses[0];
            nextLookMs = loop.nowMs() + NAME_LIFE_MS;
        }

        @Override
        public void onUnknown(String reason) {
            isAsked = false;
            nextLookMs = loop.nowMs() + NEXT_LOOK_MS;
        }
    }
}
