package org.raspilot.up.loop;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.io.IOException;
import java.net.Inet4Address;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.UnknownHostException;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashSet;
import java.util.Set;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.After;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.NameLookup.SystemResolver;
import org.raspilot.up.loop.TcpConnection.TcpListener;

public final class NameLookupTest implements NameLookup.Resolver {
    private final CountDownLatch isAnswered = new CountDownLatch(1);
    private final AtomicInteger asked = new AtomicInteger();
    private final Set<Thread> threads = Collections.synchronizedSet(new HashSet<>());
    private final Heard heard = new Heard();
    private ServerSocket server;

    @Rule
    public final RunningLoop running = new RunningLoop(new SocketSelector(), this);

    @Before
    public void listen() throws IOException {
        server = new ServerSocket(0, 50, InetAddress.getByName("127.0.0.1"));
    }

    @After
    public void close() throws IOException {
        isAnswered.countDown();
        server.close();
    }

    @Override
    public InetAddress[] resolve(String host) throws UnknownHostException {
        asked.incrementAndGet();
        threads.add(Thread.currentThread());
        if (host.startsWith("slow")) {
            try {
                isAnswered.await();
            } catch (InterruptedException stopped) {
                throw new UnknownHostException("stopped");
            }
        }
        if (host.equals("forbidden")) {
            throw new SecurityException("missing INTERNET permission?");
        }
        if (host.equals("two")) {
            return new InetAddress[] {InetAddress.getByName("127.0.0.2"),
                InetAddress.getByName("127.0.0.1")};
        }
        if (host.equals("slow") || host.matches("[0-9.]+")) {
            return new InetAddress[] {InetAddress.getByName("127.0.0.1")};
        }
        throw new UnknownHostException(host);
    }

    @Test
    public void aSlowNameServerHoldsNothingButItsAsker() {
        connect("slow", 20000, heard);
        final Heard other = new Heard();
        connect("127.0.0.1", 20000, other);
        running.await("another connection", other.has("connected"));
        running.pass(10);
        assertTrue(heard.told.isEmpty());
        assertFalse(threads.contains(loopThread()));
        isAnswered.countDown();
        running.await("the slow one", heard.has("connected"));
        running.faults.mustBeNone();
    }

    @Test
    public void aNameThatIsNotFoundInTimeIsASentence() {
        connect("slow", 50, heard);
        running.await("the time-out", heard.has("the name"));
        isAnswered.countDown();
        running.pass(50);
        assertEquals(1, heard.told.size());
            assertTrue(heard.told.get(0).contains("slow"));
    }

    @Test
    public void whoeverAsksForTheSameNameSharesTheAnswer() {
        final Heard[] all = new Heard[50];
        for (int i = 0; i < all.length; i++) {
            all[i] = new Heard();
            connect("slow", 20000, all[i]);
        }
        isAnswered.countDown();
        for (Heard each : all) {
            running.await("each", each.has("connected"));
        }
        assertEquals(1, asked.get());
    }

    @Test
    public void manySlowNamesNeedFewThreads() {
        for (int i = 0; i < 20; i++) {
            connect("slow" + i, 20000, heard);
        }
        isAnswered.countDown();
        running.await("every answer", () -> heard.told.size() == 20);
        assertTrue("used " + threads.size(), threads.size() <= 4);
    }

    @Test
    public void anUnknownNameIsASentence() {
        connect("nowhere", 20000, heard);
        running.await("the answer", heard.has("the name nowhere is not known"));
        connect("", 20000, heard);
        running.await("the answer", heard.has("the host is empty"));
        connect("forbidden", 20000, heard);
        running.await("the answer", heard.has("the name forbidden cannot be looked up"));
        running.faults.mustBeNone();
    }

    @Test
    public void theNextAddressIsTriedWhenOneRefuses() {
        connect("two", 20000, heard);
        running.await("the second", heard.has("connected"));
        assertEquals(Arrays.asList("connected"), heard.told);
    }

    @Test
    public void stopDoesNotWaitForANameServer() {
        connect("slow", 20000, heard);
        final Thread thread = loopThread();
        running.loop.stop();
        assertFalse(thread.isAlive());
        assertTrue(heard.told.isEmpty());
    }

    @Test
    public void theSystemTellsAddressesOfIpv4First() throws Exception {
        assertTrue(new SystemResolver().resolve("localhost")[0] instanceof Inet4Address);
    }

    @Test
    public void numericAddressesAreToldFromNames() {
        assertEquals("192.0.2.255", NameLookup.numeric("192.0.2.255").getHostAddress());
        for (String name : new String[] {"raspberry.local", "1.2.3", "10.0.0.1.example", "::1",
            "999.1.1.1", "a", ""}) {
            assertNull(name, NameLookup.numeric(name));
        }
    }

    private Thread loopThread() {
        return running.call(() -> Thread.currentThread());
    }

    private void connect(final String host, final int timeoutMs, final TcpListener listener) {
        running.call(() ->
                running.loop.connectTcp(host, server.getLocalPort(), timeoutMs, listener));
    }
}
