package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.net.DatagramPacket;
import java.net.DatagramSocket;
import java.net.InetAddress;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.RunningLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.net.DiscoveryClient.BroadcastAddresses;

public final class DiscoveryClientTest implements BroadcastAddresses {
    private static final String QUESTION = "Where is Raspilot? -> ";

    @Rule
    public final RunningLoop running = new RunningLoop();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, new Faults());
    private final DiscoveryClient client =
            new DiscoveryClient(loop, this, DiscoveryClient.PORT, 50001, 50000);
    private final Found found = new Found();
    private List<String> addresses = Arrays.asList("192.168.43.255", "10.255.255.255");

    @Override
    public List<String> current() {
        return addresses;
    }

    @Test
    public void itAsksEverybodyAgainAndAgainUntilAnAnswer() {
        final Cancellable search = client.find(found);
        final ScriptedNetwork.Port port = network.ports.get(0);
        assertEquals(Arrays.asList(QUESTION + "192.168.43.255:3001",
                QUESTION + "10.255.255.255:3001"), port.sent);
        loop.advance(399);
        assertEquals(2, port.sent.size());
        addresses = Arrays.asList("172.16.0.255");
        loop.advance(1);
        assertEquals(QUESTION + "172.16.0.255:3001", port.sent.get(2));
        port.come("192.168.43.7", "192.168.43.7", 3001);
        assertEquals(Arrays.asList("192.168.43.7:50001:50000"), found.told);
        assertTrue(port.isClosed);
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void wrongAnswersAreWaitedBeyond() {
        client.find(found);
        final ScriptedNetwork.Port port = network.ports.get(0);
        port.come("where are you?", "192.168.43.9", 3001);
        port.come("192.168.43.66", "192.168.43.66", 4000);
        assertTrue(found.told.isEmpty());
        port.come("", "192.168.43.7", 3001);
        assertEquals(Arrays.asList("192.168.43.7:50001:50000"), found.told);
    }

    @Test
    public void anAddressThatIsNotTheSendersOrIsPublicIsRefusedAndNamed() {
        client.find(found);
        final ScriptedNetwork.Port port = network.ports.get(0);
        port.come("203.0.113.9", "203.0.113.9", 3001);
        port.come("", "203.0.113.9", 3001);
        port.come("0.0.0.0", "192.168.43.9", 3001);
        port.come("203.0.113.9", "192.168.43.9", 3001);
        assertTrue(found.told.isEmpty());
        loop.advance(1500);
        assertEquals(1, found.told.size());
        assertTrue(found.told.get(0), found.told.get(0).contains("203.0.113.9 from 192.168.43.9"));
    }

    @Test
    public void noAnswerIsASentenceAfterOneAndAHalfSeconds() {
        client.find(found);
        loop.advance(1499);
        assertTrue(found.told.isEmpty());
        loop.advance(1);
        assertTrue(found.told.get(0).contains("[192.168.43.255, 10.255.255.255]"));
        assertEquals(4 * 2, network.ports.get(0).sent.size());
        assertTrue(network.ports.get(0).isClosed);
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void noNetworkIsAnotherSentence() {
        addresses = Collections.emptyList();
        client.find(found);
        loop.advance(1500);
        network.hasNoSockets = true;
        client.find(found);
        assertTrue(found.told.get(0).contains("[]"));
        assertTrue(found.told.get(1).endsWith(": too many"));
    }

    @Test
    public void aNetworkThatComesWhileItLooksIsAskedIn() {
        final List<String> later = addresses;
        addresses = Collections.emptyList();
        client.find(found);
        addresses = later;
        loop.advance(400);
        network.ports.get(0).come("10.0.0.1", "10.0.0.1", 3001);
        assertEquals(Arrays.asList("10.0.0.1:50001:50000"), found.told);
    }

    @Test
    public void aCancelledSearchTellsNothing() {
        final Cancellable search = client.find(found);
        search.cancel();
        search.cancel();
        loop.advance(60000);
        assertTrue(found.told.isEmpty());
        assertTrue(network.ports.get(0).isClosed);
    }

    @Test
    public void aRealDiscoveryIsFoundByBroadcast() throws Exception {
        final DatagramSocket server = new DatagramSocket(0, InetAddress.getByName("0.0.0.0"));
        server.setSoTimeout(20000);
        addresses = Arrays.asList("127.255.255.255");
        running.call(() -> {
            return new DiscoveryClient(running.loop, DiscoveryClientTest.this,
                    server.getLocalPort(), 1, 2).find(found);
        });
        final DatagramPacket question = new DatagramPacket(new byte[600], 600);
        server.receive(question);
        final byte[] answer = "127.0.0.1".getBytes("US-ASCII");
        server.send(new DatagramPacket(answer, answer.length, question.getSocketAddress()));
        running.await("the answer", () -> found.told.contains("127.0.0.1:1:2"));
        server.close();
        running.faults.mustBeNone();
    }

    @Test
    public void theSystemsInterfacesHaveAddressesToAsk() {
        final List<String> all = new InterfaceBroadcasts().current();
        assertFalse(all.isEmpty());
        for (String each : all) {
            assertTrue(each, each.matches("[0-9]+(\\.[0-9]+){3}"));
        }
    }
}
