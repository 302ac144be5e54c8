package org.raspilot.up.net;

import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;

/** Records the events of an {@link UpSocket}; a line is recorded with {@code < } before it. */
class Diary implements UpSocketListener {
    final List<String> told = new ArrayList<>();
    int statuses;

    @Override
    public void onConnected() {
        told.add("connected");
    }

    @Override
    public void onReceived(byte[] bytes, int length) {
        told.add("< " + new String(bytes, 0, length, Charset.forName("UTF-8")));
    }

    @Override
    public void onLost(String reason) {
        told.add("lost: " + reason);
    }

    @Override
    public void onStatus() {
        statuses++;
    }
}
