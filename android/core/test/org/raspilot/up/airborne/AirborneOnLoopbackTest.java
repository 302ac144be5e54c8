package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;

import java.io.BufferedReader;
import java.io.DataInputStream;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.Charset;
import java.util.Random;
import org.junit.After;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.RunningLoop;
import org.raspilot.up.providers.Attitude;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.Side;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.OrientationFrame;

/** The airborne side on its real loop and real sockets, against a server of a few lines. */
public final class AirborneOnLoopbackTest {
    private static final int MAX_WAIT_MS = 20000;
    private static final Charset UTF_8 = Charset.forName("UTF-8");

    @Rule
    public final RunningLoop running = new RunningLoop();

    private final AirborneBench sensors = new AirborneBench();
    private ServerSocket general;
    private ServerSocket orientation;

    @Before
    public void listen() throws IOException {
        general = server();
        orientation = server();
    }

    @After
    public void close() throws IOException {
        general.close();
        orientation.close();
        running.faults.mustBeNone();
    }

    @Test
    public void sensorsLeaveCommandsAreAnsweredAndALostLinkComesBack() throws Exception {
        final Mounting mounting = Mounting.of(Side.LEFT, Side.BACK);
        final Airborne airborne = running.call(() -> {
            Airborne made = new Airborne(running.loop, AirborneBench.blackBox()
                    .host("127.0.0.1").generalPort(general.getLocalPort())
                    .orientationPort(orientation.getLocalPort()).mounting(mounting).build(),
                    sensors.sensors, sensors, sensors, new Random(1));
            made.start();
            return made;
        });
        Socket link = accept(general);
        give(airborne, mounting, 20);
        BufferedReader lines = reader(link);
        assertEquals("up.location.update", read(lines).name);
        assertEquals("up.heading.change", read(lines).name);
        assertEquals(83L, read(lines).data.get("level"));

        Socket frames = accept(orientation);
        running.await("the link for orientation", () -> airborne.sink().isOrientationOpen());
        give(airborne, mounting, 20);
        OrientationFrame frame = frame(frames);
        assertEquals(20, frame.rollDeg, 0.01);
        assertEquals(-5, frame.pitchDeg, 0.01);

        link.getOutputStream().write(("{\"name\": \"android.speak\", "
                + "\"data\": {\"text\": \"ahoj\"}, \"id\": \"q\"}\n").getBytes(UTF_8));
        GeneralMessage answer = read(lines);
        while (!answer.name.equals("up.ack")) {
            answer = read(lines);
        }
        assertEquals("q", answer.data.get("id"));

        link.close();
        Socket again = accept(general);
        give(airborne, mounting, 30);
        BufferedReader fresh = reader(again);
        GeneralMessage battery = read(fresh);
        while (!battery.name.equals("android.battery")) {
            battery = read(fresh);
        }
        running.call(() -> {
            assertEquals("[ahoj]", sensors.said.toString());
            assertEquals(2, airborne.status().counters.connections);
            airborne.stop();
            return null;
        });
        while (fresh.readLine() != null) {
            // Until everything sent before the stop has arrived.
        }
        again.close();
        frames.close();
    }

    /** Makes the sensors deliver on the loop, once there is a link for their readings. */
    private void give(final Airborne airborne, final Mounting mounting, final double rollDeg) {
        running.await("the link for Commands", () -> {
            if (!airborne.status().isConnected) {
                return false;
            }
            sensors.gps.give(AirborneBench.HERE);
            sensors.rotation.give(mounting.rotation(
                    new Attitude(rollDeg, -5, 80), running.loop.nowMs()));
            sensors.battery.give(new BatteryLevel(83));
            return true;
        });
    }

    private static ServerSocket server() throws IOException {
        ServerSocket server = new ServerSocket(0, 5, InetAddress.getByName("127.0.0.1"));
        server.setSoTimeout(MAX_WAIT_MS);
        return server;
    }

    private static Socket accept(ServerSocket server) throws IOException {
        Socket socket = server.accept();
        socket.setSoTimeout(MAX_WAIT_MS);
        return socket;
    }

    private static BufferedReader reader(Socket socket) throws IOException {
        return new BufferedReader(new InputStreamReader(socket.getInputStream(), UTF_8));
    }

    private static GeneralMessage read(BufferedReader lines) throws Exception {
        byte[] line = lines.readLine().getBytes(UTF_8);
        return GeneralMessage.read(line, line.length);
    }

    private static OrientationFrame frame(Socket socket) throws IOException {
        DataInputStream in = new DataInputStream(socket.getInputStream());
        return new OrientationFrame(in.readFloat(), in.readFloat(), in.readFloat(),
                in.readFloat(), in.readFloat(), in.readFloat());
    }
}
