package org.raspilot.up.virtual_phone;

import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** A TCP connection of a simulator. */
final class PipedConnection implements TcpConnection {
    /** How many bytes it takes before some have left: as a small send buffer. */
    static final int ROOM_BYTES = 8192;

    private final PipedNetwork network;
    private final long id;
    private final TcpListener listener;
    private int room = ROOM_BYTES;
    private boolean isConnected;
    private boolean isClosed;
    private boolean isFull;

    interface Event {
        void apply(PipedConnection connection);
    }

    /** Takes its number on the pipe. */
    PipedConnection(PipedNetwork network, long id, TcpListener listener) {
        this.network = network;
        this.id = id;
        this.listener = listener;
    }

    /**
     * Returns the event of that kind.
     *
     * @param detail the third element of its line
     * @throws OptionException for an unknown kind (a sentence)
     */
    static Event parse(String kind, final Object detail) throws OptionException {
        if ("connected".equals(kind)) {
            return connection -> {
                connection.isConnected = true;
                connection.listener.onConnected();
            };
        }
        if ("bytes".equals(kind)) {
            final byte[] bytes = ((String) detail).getBytes(PipedNetwork.BYTES);
            return connection -> connection.listener.onBytes(bytes, bytes.length);
        }
        if ("room".equals(kind)) {
            final int count = ((Long) detail).intValue();
            return connection -> connection.makeRoom(count);
        }
        if ("closed".equals(kind)) {
            final String reason = (String) detail;
            return connection -> {
                connection.end();
                connection.listener.onClosed(reason);
            };
        }
        throw new OptionException("net: unknown event '" + kind + "'");
    }

    @Override
    public int write(byte[] bytes, int offset, int length) {
        if (!isConnected || isClosed) {
            return 0;
        }
        int taken = Math.min(length, room);
        if (taken > 0) {
            room -= taken;
            network.request("write", id, new String(bytes, offset, taken, PipedNetwork.BYTES));
        }
        if (taken < length && !isFull) {
            isFull = true;
            network.request("full", id);
        }
        return taken;
    }

    @Override
    public void close() {
        if (!isClosed) {
            end();
            network.request("close", id);
        }
    }

    private void makeRoom(int count) {
        room += count;
        if (isFull) {
            isFull = false;
            listener.onWritable();
        }
    }

    private void end() {
        isClosed = true;
        network.remove(id);
    }
}
