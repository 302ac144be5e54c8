package org.raspilot.up.loop;

import java.io.IOException;
import java.nio.channels.SelectableChannel;
import java.nio.channels.SelectionKey;
import java.nio.channels.Selector;
import java.util.ArrayList;
import java.util.List;

/**
 * Sleeps until a socket is ready. A selector that returns again and again without a reason, as
 * some do after a connection broke, is replaced by a new one. Only {@link #wakeup} is for others
 * than the loop's thread.
 */
class SocketSelector {
    private static final int MAX_EMPTY_ROUNDS = 256;

    private volatile Selector selector;
    private int emptyRounds;

    void open() throws IOException {
        selector = openSelector();
    }

    /** Makes the current or next wait return immediately. */
    void wakeup() {
        final Selector sleeping = selector;
        if (sleeping != null) {
            sleeping.wakeup();
        }
    }

    SelectionKey register(SelectableChannel channel, int operations, SelectorHandler ready)
            throws IOException {
        return channel.register(selector, operations, ready);
    }

    /** Notes that the wakeup had a reason: a call or a timer. */
    void hadReason() {
        emptyRounds = 0;
    }

    /** Returns the ready keys after at most {@code waitMs}; 0: no wait, -1: no limit. */
    List<SelectionKey> await(long waitMs) throws IOException {
        final boolean isReplaced = emptyRounds > MAX_EMPTY_ROUNDS;
        if (isReplaced) {
            replace();
        }
        // Before the wait, so that a selector which only throws is replaced as well.
        emptyRounds++;
        if (waitMs == 0 || isReplaced) {
            // The old selector's wakeups do not reach the new one: the loop checks for calls first.
            selector.selectNow();
        } else {
            selector.select(waitMs < 0 ? 0 : waitMs);
        }
        final List<SelectionKey> ready = new ArrayList<>(selector.selectedKeys());
        selector.selectedKeys().clear();
        if (!ready.isEmpty()) {
            emptyRounds = 0;
        }
        return ready;
    }

    List<SelectorHandler> registered() {
        final List<SelectorHandler> all = new ArrayList<>();
        for (SelectionKey key : selector.keys()) {
            all.add((SelectorHandler) key.attachment());
        }
        return all;
    }

    /** Closes it; later wakeups have no effect. */
    void close() throws IOException {
        selector.close();
    }

    /** Opens another; a test gives one that is broken. */
    Selector openSelector() throws IOException {
        return Selector.open();
    }

    private void replace() throws IOException {
        final Selector old = selector;
        final Selector fresh = openSelector();
        boolean isMoved = false;
        try {
            for (SelectionKey key : old.keys()) {
                if (key.isValid()) {
                    final SelectorHandler ready = (SelectorHandler) key.attachment();
                    final int operations = key.interestOps();
                    key.cancel();
                    ready.onMoved(key.channel().register(fresh, operations, ready));
                }
            }
            isMoved = true;
        } finally {
            if (!isMoved) {
                // One left open with each further try would use up the process's files.
                fresh.close();
            }
        }
        selector = fresh;
        emptyRounds = 0;
        old.close();
    }
}
