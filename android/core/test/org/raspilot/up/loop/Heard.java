package org.raspilot.up.loop;

import java.io.ByteArrayOutputStream;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import org.raspilot.up.loop.TcpConnection.TcpListener;

/** Records the events of a TCP connection; to be read on the loop. */
class Heard implements TcpListener {
    final List<String> told = new ArrayList<>();
    final ByteArrayOutputStream bytes = new ByteArrayOutputStream();

    @Override
    public void onConnected() {
        told.add("connected");
    }

    @Override
    public void onBytes(byte[] read, int length) {
        bytes.write(read, 0, length);
    }

    @Override
    public void onWritable() {
        told.add("writable");
    }

    @Override
    public void onClosed(String code, String reason) {
        told.add(reason);
    }

    /** Returns whether an event with that prefix was recorded. */
    Callable<Boolean> has(final String beginning) {
        return () -> {
            for (String each : told) {
                if (each.startsWith(beginning)) {
                    return true;
                }
            }
            return false;
        };
    }

    /** Returns whether that many bytes arrived. */
    Callable<Boolean> hasBytes(final int count) {
        return () -> bytes.size() >= count;
    }
}
