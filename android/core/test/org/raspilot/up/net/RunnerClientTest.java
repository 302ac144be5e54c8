package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.io.OutputStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.net.SocketException;
import java.util.Arrays;
import org.junit.After;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.RunningLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.security.TestAircraft;

public final class RunnerClientTest {
    private static final RunnerRequest REQUEST = new RunnerRequest("glider-1", "", null);
    private static final String ASKED = "{\"aircraft\": \"glider-1\"}\n";
    private static final String ANSWER =
            "{\"running\": true, \"ports\": {\"general\": 50001, \"orientation\": 50000}}";

    @Rule
    public final RunningLoop running = new RunningLoop();
    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    private final RunnerClient client = new RunnerClient(loop, "runner", 3002, null, REQUEST);
    private final Found found = new Found();

    @After
    public void nothingWasThrownAndNothingIsLeft() {
        faults.mustBeNone();
        running.faults.mustBeNone();
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void itAsksInOneLineAndGoesWhereTheAnswerSays() {
        assertNull(client.lastAnswer());
        final Cancellable search = client.find(found);
        final ScriptedNetwork.Connection runner = network.newest();
        assertEquals("runner:3002 2000", runner.host + ":" + runner.port + " " + runner.timeoutMs);
        runner.room = 5;
        runner.accept();
        runner.makeRoom(100);
        assertEquals(ASKED, runner.written());
        loop.advance(19000);
        runner.say(ANSWER.substring(0, 20));
        runner.say(ANSWER.substring(20));
        assertTrue(found.told.isEmpty());
        runner.say("\n{\"running\": false}\n");
        assertEquals(Arrays.asList("runner:50001:50000"), found.told);
        assertTrue(runner.isClosed);
        assertEquals(50001, client.lastAnswer().endpoint.generalPort);
    }

    @Test
    public void aRefusalIsTheRunnersSentence() {
        client.find(found);
        network.newest().accept();
        network.newest().say("{\"running\": false, \"error\": \"no profile\"}\n");
        assertTrue(found.told.get(0).endsWith(": no profile"));
        assertEquals(Arrays.asList("refused"), found.codes);
        assertTrue(network.newest().isClosed);
        assertNull(client.lastAnswer());
    }

    @Test
    public void aRefusalHasTheRunnersCode() {
        client.find(found);
        network.newest().accept();
        network.newest().say("{\"running\": false, \"code\": \"unprotected\"}\n");
        assertEquals(Arrays.asList("unprotected"), found.codes);
    }

    @Test
    public void withAKeyAPlainAnswerIsNotBelieved() {
        new RunnerClient(loop, "runner", 3002, null, new RunnerRequest("glider-1", "",
                Pairing.parse(TestAircraft.TEXT))).find(found);
        network.newest().accept();
        assertFalse(network.newest().written().contains("aircraft"));
        network.newest().say(ANSWER + "\n");
        assertEquals(Arrays.asList("unprotected"), found.codes);
        assertTrue(network.newest().isClosed);
    }

    @Test
    public void noRunnerIsASentence() {
        client.find(found);
        network.newest().end("Connection refused");
        assertTrue(found.told.get(0).endsWith(": Connection refused"));
    }

    @Test
    public void aRunnerThatHangsUpIsASentence() {
        client.find(found);
        network.newest().accept();
        network.newest().say(ANSWER);
        network.newest().end("runner:3002 closed");
        assertTrue(found.told.get(0).endsWith(": runner:3002 closed"));
    }

    @Test
    public void aRunnerThatNeverAnswersIsASentenceAfterTwentySeconds() {
        client.find(found);
        loop.advance(1000);
        network.newest().accept();
        for (int i = 0; i < 199; i++) {
            loop.advance(100);
            network.newest().say(" ");
        }
        assertTrue(found.told.isEmpty());
        loop.advance(100);
        assertEquals(1, found.told.size());
        assertTrue(network.newest().isClosed);
    }

    @Test
    public void aCancelledRequestTellsNothing() {
        final Cancellable search = client.find(found);
        search.cancel();
        assertTrue("connecting", network.newest().isClosed);
        final Cancellable another = client.find(found);
        network.newest().accept();
        another.cancel();
        another.cancel();
        assertTrue("asking", network.newest().isClosed);
        loop.advance(60000);
        assertTrue(found.told.isEmpty());
    }

    @Test
    public void aRealRunnerIsAsked() throws Exception {
        final ServerSocket server = listen();
        find(server);
        final Socket peer = server.accept();
        assertEquals(ASKED.trim(), new BufferedReader(
                new InputStreamReader(peer.getInputStream(), "UTF-8")).readLine());
        peer.getOutputStream().write((ANSWER + "\n").getBytes("UTF-8"));
        await("127.0.0.1:50001:50000");
        assertEquals(-1, peer.getInputStream().read());
        server.close();
    }

    @Test
    public void anAnswerOfAGigabyteIsCutOff() throws Exception {
        final ServerSocket server = listen();
        find(server);
        final Socket peer = server.accept();
        final byte[] chunk = new byte[65536];
        Arrays.fill(chunk, (byte) '[');
        final OutputStream out = peer.getOutputStream();
        long sent = 0;
        try {
            while (sent < 1L << 30) {
                out.write(chunk);
                sent += chunk.length;
            }
        } catch (SocketException cutOff) {
            assertTrue("took " + sent, sent < 1L << 26);
        }
        assertTrue(sent < 1L << 30);
        await("the runner's answer is longer than 65536 bytes");
        server.close();
    }

    private static ServerSocket listen() throws Exception {
        final ServerSocket server = new ServerSocket(0, 5, InetAddress.getByName("127.0.0.1"));
        server.setSoTimeout(20000);
        return server;
    }

    private void find(final ServerSocket server) {
        running.call(() -> {
            return new RunnerClient(running.loop, "127.0.0.1", server.getLocalPort(), null, REQUEST)
                    .find(found);
        });
    }

    private void await(final String told) {
        running.await(told, () -> found.told.equals(Arrays.asList(told)));
    }
}
