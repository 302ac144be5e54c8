package org.raspilot.up.loop;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.io.IOException;
import java.net.DatagramPacket;
import java.net.DatagramSocket;
import java.net.InetAddress;
import java.nio.channels.CancelledKeyException;
import java.nio.channels.SelectableChannel;
import java.nio.channels.SelectionKey;
import java.nio.channels.Selector;
import java.nio.channels.spi.AbstractSelectableChannel;
import java.nio.channels.spi.AbstractSelectionKey;
import java.nio.channels.spi.AbstractSelector;
import java.nio.channels.spi.SelectorProvider;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.NameLookup.SystemResolver;

public final class SocketSelectorTest {
    private final List<Selector> opened = new ArrayList<>();
    private final List<String> heard = new ArrayList<>();

    @Rule
    public final RunningLoop running = new RunningLoop(new SocketSelector() {
        @Override
        Selector openSelector() throws IOException {
            final Selector next = opened.isEmpty() ? new Spinner() : super.openSelector();
            opened.add(next);
            return next;
        }
    }, new SystemResolver());

    @Test
    public void aSelectorThatReturnsWithoutReasonIsReplacedAndItsSocketsMove() throws Exception {
        final DatagramSocket peer = new DatagramSocket(0, InetAddress.getByName("127.0.0.1"));
        peer.setSoTimeout(20000);
        final UdpPort port = running.call(() ->
                running.loop.openUdp((bytes, length, host, from) -> heard.add(host)));
        running.call(() -> port.send(new byte[1], "127.0.0.1", peer.getLocalPort()));
        final DatagramPacket packet = new DatagramPacket(new byte[1], 1);
        peer.receive(packet);
        peer.send(packet);
        running.await("a datagram by the new selector", () -> heard.size() == 1);
        peer.close();
        final long before = running.loop.rounds();
        running.pass(300);
        assertEquals(2, opened.size());
        final long rounds = running.loop.rounds() - before;
        assertTrue("woke " + rounds + " times", rounds <= 6);
        running.faults.mustBeNone();
    }

    @Test
    public void aCallThatWakesTheSelectorBeingReplacedIsCarriedOut() throws Exception {
        final SelectorLoop[] loop = new SelectorLoop[1];
        final CountDownLatch called = new CountDownLatch(1);
        loop[0] = new SelectorLoop("replacing", new Faults(), running.clock(),
                new SocketSelector() {
            private boolean hasSpun;

            @Override
            Selector openSelector() throws IOException {
                if (!hasSpun) {
                    hasSpun = true;
                    return new Spinner();
                }
                final Thread poster = new Thread() {
                    @Override
                    public void run() {
                        loop[0].post(() -> called.countDown());
                    }
                };
                poster.start();
                try {
                    poster.join();
                } catch (InterruptedException error) {
                    throw new IOException(error);
                }
                return super.openSelector();
            }
        }, new SystemResolver());
        loop[0].start();
        try {
            assertTrue(called.await(20, TimeUnit.SECONDS));
        } finally {
            loop[0].stop();
        }
    }

    @Test
    public void aSelectorThatThrowsDoesNotEndTheThread() throws Exception {
        final int throwing = 3;
        final int[] waits = new int[1];
        final Faults faults = new Faults();
        final SelectorLoop loop = new SelectorLoop("throwing", faults, running.clock(),
                new SocketSelector() {
            @Override
            List<SelectionKey> await(long waitMs) throws IOException {
                waits[0]++;
                if (waits[0] <= throwing) {
                    throw new CancelledKeyException();
                }
                return super.await(waitMs);
            }
        }, new SystemResolver());
        final CountDownLatch latch = new CountDownLatch(1);
        loop.start();
        try {
            loop.post(new Runnable() {
                @Override
                public void run() {
                    if (waits[0] > throwing) {
                        latch.countDown();
                    } else {
                        loop.schedule(0, this);
                    }
                }
            });
            assertTrue(latch.await(20, TimeUnit.SECONDS));
            assertEquals(throwing, faults.all().size());
            assertTrue(faults.all().get(0) instanceof CancelledKeyException);
        } finally {
            loop.stop();
        }
    }

    /** A selector that never sleeps and never sees anything. */
    private static final class Spinner extends AbstractSelector {
        private final Set<SelectionKey> keys = new HashSet<>();
        private final Set<SelectionKey> selected = new HashSet<>();

        Spinner() {
            super(SelectorProvider.provider());
        }

        @Override
        protected SelectionKey register(AbstractSelectableChannel channel, int operations,
                Object attachment) {
            final SelectionKey key = new Key(this, channel, operations);
            key.attach(attachment);
            keys.add(key);
            return key;
        }

        @Override
        protected void implCloseSelector() {
            keys.clear();
        }

        @Override
        public Set<SelectionKey> keys() {
            return keys;
        }

        @Override
        public Set<SelectionKey> selectedKeys() {
            return selected;
        }

        @Override
        public int selectNow() {
            return 0;
        }

        @Override
        public int select(long timeoutMs) {
            return 0;
        }

        @Override
        public int select() {
            return 0;
        }

        @Override
        public Selector wakeup() {
            return this;
        }
    }

    private static final class Key extends AbstractSelectionKey {
        private final Selector selector;
        private final SelectableChannel channel;
        private final int operations;

        Key(Selector selector, SelectableChannel channel, int operations) {
            this.selector = selector;
            this.channel = channel;
            this.operations = operations;
        }

        @Override
        public SelectableChannel channel() {
            return channel;
        }

        @Override
        public Selector selector() {
            return selector;
        }

        @Override
        public int interestOps() {
            return operations;
        }

        @Override
        public SelectionKey interestOps(int wanted) {
            return this;
        }

        @Override
        public int readyOps() {
            return 0;
        }
    }
}
