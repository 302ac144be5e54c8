package org.raspilot.up.airborne;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.RotationRate;
import org.raspilot.up.providers.Sensors;
import org.raspilot.up.providers.TestSource;

/** A phone on board whose sensors, network and time a test controls. */
final class AirborneBench implements Speaker, AirborneListener {
    static final Fix HERE = new Fix(48.1, 17.1, 150.0, null, null, null, null, null);
    static final Rotation LEVEL = new Rotation(1, 0, 0, 0, 0);

    static final int ROOM = 1 << 30;
    static final int FRAME = 24;

    final ScriptedNetwork network = new ScriptedNetwork();
    final Faults faults = new Faults();
    final ManualLoop loop = new ManualLoop(network, faults);
    final TestSource<Fix> gps = new TestSource<>("GPS");
    final TestSource<Rotation> rotation = new TestSource<>("rotation vector");
    final TestSource<RotationRate> gyroscope = new TestSource<>("gyroscope");
    final TestSource<Pressure> barometer = new TestSource<>("barometer");
    final TestSource<BatteryLevel> battery = new TestSource<>("battery");
    final Sensors sensors = new Sensors(gps, rotation, gyroscope, barometer, battery);
    final List<String> events = new ArrayList<>();
    final List<String> sentences = new ArrayList<>();
    final List<String> said = new ArrayList<>();
    Airborne airborne;

    /** Returns settings with a Raspberry Pi at a fixed host. */
    static AirborneSettings.Builder fixed() {
        return new AirborneSettings.Builder().host("10.0.0.1");
    }

    /** Returns settings of Black Box Mode with a server that runs already. */
    static AirborneSettings.Builder blackBox() {
        return fixed().mode(AirborneMode.BLACK_BOX);
    }

    /** Creates the phone and starts it. */
    Airborne start(AirborneSettings settings) {
        airborne = new Airborne(loop, settings, sensors, this, this, new Random(1));
        airborne.start();
        loop.advance(0);
        return airborne;
    }

    /** Starts it with the link for Commands connected. */
    Airborne connected(AirborneSettings settings) {
        start(settings);
        accept(settings.generalPort);
        return airborne;
    }

    /** Opens the newest connection to a port. */
    ScriptedNetwork.Connection accept(int port) {
        ScriptedNetwork.Connection connection = to(port);
        connection.room = ROOM;
        connection.accept();
        loop.advance(0);
        return connection;
    }

    /** Returns the newest connection to a port, or null. */
    ScriptedNetwork.Connection to(int port) {
        ScriptedNetwork.Connection found = null;
        for (ScriptedNetwork.Connection connection : network.connections) {
            found = connection.port == port ? connection : found;
        }
        return found;
    }

    /** Returns the newest connection for Commands. */
    ScriptedNetwork.Connection general() {
        return to(50001);
    }

    /** Delivers a line from the Raspberry Pi. */
    void hear(String line) {
        general().say(line + "\n");
        loop.advance(0);
    }

    /** Returns the number of orientation frames that the system accepted since the last call. */
    int frames() {
        ScriptedNetwork.Connection connection = to(50000);
        int bytes = ROOM - connection.room;
        if (bytes % FRAME != 0) {
            throw new AssertionError("half a frame: " + bytes + " bytes");
        }
        connection.room = ROOM;
        return bytes / FRAME;
    }

    /** Returns all datagrams that left, with their destinations. */
    List<String> datagrams() {
        List<String> sent = new ArrayList<>();
        for (ScriptedNetwork.Port port : network.ports) {
            sent.addAll(port.sent);
        }
        return sent;
    }

    /** Returns the sent lines since the last call, without their ids. */
    List<String> lines() {
        String written = general().written();
        if (written.isEmpty()) {
            return Collections.emptyList();
        }
        List<String> lines = new ArrayList<>();
        for (String line : written.split("\n", -1)) {
            lines.add(line);
        }
        if (!lines.remove(lines.size() - 1).isEmpty()) {
            throw new AssertionError("half a line: " + written);
        }
        return lines;
    }

    /** Returns how many of the lines are of that Command. */
    static int count(List<String> lines, String name) {
        int count = 0;
        for (String line : lines) {
            count += line.contains("{\"name\": \"" + name + "\"") ? 1 : 0;
        }
        return count;
    }

    /** Makes every sensor deliver a reading each periodMs for that many ms. */
    void fly(long periodMs, long forMs) {
        for (long passed = 0; passed < forMs; passed += periodMs) {
            loop.advance(periodMs);
            gps.give(HERE);
            barometer.give(new Pressure(1000));
            gyroscope.give(new RotationRate(0, 0, 0, loop.nowMs()));
            rotation.give(new Rotation(1, 0, 0, 0, loop.nowMs()));
            battery.give(new BatteryLevel(80));
        }
    }

    @Override
    public void onConnected(Endpoint place) {
        events.add("connected " + place);
    }

    @Override
    public void onDisconnected(String code, String reason) {
        events.add("lost: " + code);
    }

    @Override
    public void onPanic(long delayMs) {
        events.add("panic " + delayMs);
    }

    @Override
    public void onEvent(String code, String sentence) {
        events.add(code);
        sentences.add(sentence);
    }

    @Override
    public void speak(String text) {
        said.add(text);
    }
}
