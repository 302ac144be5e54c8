package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.After;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandRegistry;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.ground.TokenStore.MemoryTokenStore;
import org.raspilot.up.loop.RunningLoop;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.ProxyRole;

/** A ground over real sockets on a real loop, with a proxy that the test plays line by line. */
public final class GroundSideSocketTest implements GroundListener {
    private static final Charset UTF_8 = Charset.forName("UTF-8");
    private static final String TOKEN = "0123456789abcdef0123456789abcdef";
    private static final int MAX_WAIT_MS = 20000;

    @Rule
    public final RunningLoop running = new RunningLoop();

    private final List<Telemetry> frames = new ArrayList<>();
    private final List<Answer> answers = new ArrayList<>();
    private ServerSocket server;
    private Socket proxy;
    private BufferedReader lines;
    private GroundStatus status;
    private GroundSide ground;

    @Before
    public void listen() throws IOException {
        server = new ServerSocket(0, 5, InetAddress.getByName("127.0.0.1"));
        server.setSoTimeout(MAX_WAIT_MS);
    }

    @After
    public void close() throws IOException {
        running.call(() -> {
            ground.stop();
            return null;
        });
        server.close();
        if (proxy != null) {
            proxy.close();
        }
        running.faults.mustBeNone();
    }

    private void start(final ProxyRole seat, final boolean isDirect) throws IOException {
        running.call(() -> {
            ground = new GroundSide(running.loop, new GroundSettings("127.0.0.1",
                    server.getLocalPort(), "glider", seat, isDirect), new MemoryTokenStore(),
                    new CommandExecutor(CommandRegistry.builtin(), null),
                    GroundSideSocketTest.this, new Random());
            ground.start();
            return null;
        });
        accept();
    }

    private void accept() throws IOException {
        proxy = server.accept();
        proxy.setSoTimeout(MAX_WAIT_MS);
        lines = new BufferedReader(new InputStreamReader(proxy.getInputStream(), UTF_8));
    }

    private void say(String text) throws IOException {
        proxy.getOutputStream().write(text.getBytes(UTF_8));
        proxy.getOutputStream().flush();
    }

    /** Returns the next line that is neither a heartbeat nor the request for the gains. */
    private String line() throws IOException {
        String line = lines.readLine();
        while (line != null && (line.isEmpty() || line.contains("\"request\": true"))) {
            line = lines.readLine();
        }
        return line;
    }

    private void awaitFrames(final int count) {
        running.await(count + " frames", () -> frames.size() >= count);
    }

    private void awaitState(final LinkState state) {
        running.await(state + "", () -> status != null && status.link == state);
    }

    private static String frame(long beacon, String data) {
        return "{\"name\": \"up.telemetry.update\", \"data\": " + data + ", \"beacon\": " + beacon
                + "}\n";
    }

    @Test
    public void aFlightWithALossInItsMiddle() throws IOException, MalformedException {
        start(ProxyRole.COMMAND, false);
        assertEquals("UP1 aircraft=glider seat=command", line());
        say("UP1 ok aircraft=glider seat=command token=" + TOKEN + "\nUP1 seat holder=1\n"
                + "UP1 aircraft online\n" + frame(10, "{\"altitude\": 12.5}"));
        awaitFrames(1);
        running.call(() -> {
            assertEquals(12.5, frames.get(0).number("altitude"), 0);
            ground.onShown(10L);
            ground.send(Commands.flightMode("FBW"), answer -> answers.add(answer));
            return null;
        });
        final byte[] sent = line().getBytes(UTF_8);
        final GeneralMessage command = GeneralMessage.read(sent, sent.length);
        assertEquals("FBW", command.data.get("mode"));
        assertEquals(Long.valueOf(10), command.beacon);
        say("{\"name\": \"up.ack\", \"data\": {\"id\": \"" + command.id + "\"}}\n");
        running.await("the answer", () -> answers.size() == 1 && answers.get(0).isAck());

        // Half a line, then the end: the next connection begins with its own first line.
        say("{\"name\": \"up.telemetry.update\", \"da");
        proxy.close();
        accept();
        awaitState(LinkState.CONNECTING);
        assertEquals("UP1 aircraft=glider seat=command token=" + TOKEN, line());
        say("UP1 ok aircraft=glider seat=command token=" + TOKEN + "\n"
                + frame(11, "{\"altitude\": 13.5}"));
        // The first frame, the same with its link lost, and the new one.
        awaitFrames(3);
        running.call(() -> {
            assertTrue(frames.get(1).age.isLinkLost);
            assertEquals(13.5, frames.get(2).number("altitude"), 0);
            assertEquals(0, ground.status().counters.malformed);
            assertEquals(ControlStatus.OURS, ground.status().control);
            return null;
        });
    }

    @Test
    public void silenceIsSeenWithoutAnythingHappening() throws IOException {
        start(ProxyRole.LISTEN, true);
        say(frame(1, "{}"));
        awaitFrames(1);
        running.await("silence", () ->
                status.isOpen() && status.isSilent && status.counters.frames == 1);
        running.call(() -> {
            assertTrue(ground.alarms().snapshot().has(Alarm.Kind.SILENT));
            return null;
        });
    }

    @Override
    public void onTelemetry(Telemetry telemetry) {
        frames.add(telemetry);
    }

    @Override
    public void onStatus(GroundStatus now) {
        status = now;
    }

    @Override
    public void onChanged() {
    }
}
