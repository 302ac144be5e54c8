package org.raspilot.up.net;

import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;

/** Records the events of an {@link UpSocket}; a line is recorded with {@code < } before it. */
class Diary implements UpSocketListener {
    final List<String> told = new ArrayList<>();
    final List<UpSocketStatus.State> states = new ArrayList<>();

    @Override
    public void onConnected(UpSocket socket) {
        told.add("connected");
    }

    @Override
    public void onReceived(UpSocket socket, byte[] bytes, int length) {
        told.add("< " + new String(bytes, 0, length, Charset.forName("UTF-8")));
    }

    @Override
    public void onLost(UpSocket socket, String reason) {
        told.add("lost: " + reason);
    }

    @Override
    public void onStatus(UpSocket socket) {
        states.add(socket.status().state);
    }
}
