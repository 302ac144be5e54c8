package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.rules.ExternalResource;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandRegistry;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.TokenStore.MemoryTokenStore;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.ProxyRole;

/** A ground on a stopped clock whose proxy is the test; records all its reports. */
final class GroundBench extends ExternalResource implements GroundListener {
    static final String TOKEN = "0123456789abcdef0123456789abcdef";
    static final String OTHER_TOKEN = "ffffffffffffffffffffffffffffffff";

    final Faults faults = new Faults();
    final ScriptedNetwork network = new ScriptedNetwork();
    final ManualLoop loop = new ManualLoop(network, faults);
    final MemoryTokenStore tokens = new MemoryTokenStore();
    final List<Throwable> handlerFaults = new ArrayList<>();
    final CommandExecutor executor =
            new CommandExecutor(CommandRegistry.builtin(), (handler, command, fault) ->
                    handlerFaults.add(fault));
    final List<Telemetry> frames = new ArrayList<>();
    final List<Answer> answers = new ArrayList<>();
    GroundStatus status;
    int changes;
    GroundSettings settings = settings(ProxyRole.COMMAND, false);
    GroundSide ground;

    static GroundSettings settings(ProxyRole seat, boolean isDirect) {
        return new GroundSettings("192.0.2.9", 3004, "glider", seat, isDirect);
    }

    @Override
    protected void after() {
        faults.mustBeNone();
    }

    /** Creates the ground with these settings and starts it. */
    GroundBench start(GroundSettings with) {
        settings = with;
        ground = new GroundSide(loop, settings, tokens, executor, this, new Random(7));
        ground.start();
        loop.advance(0);
        return this;
    }

    /** Starts, accepts as the proxy, and grants that seat. */
    GroundBench open(ProxyRole seat) {
        start(settings(seat, false));
        accept(seat);
        say("UP1 seat holder=" + (seat == ProxyRole.COMMAND ? "1" : "none"));
        say("UP1 aircraft online");
        return this;
    }

    /** Accepts the newest connection as the proxy and answers the hello. */
    void accept(ProxyRole seat) {
        peer().accept();
        say("UP1 ok aircraft=glider seat=" + seat.word() + " token=" + TOKEN);
    }

    ScriptedNetwork.Connection peer() {
        return network.newest();
    }

    void say(String line) {
        peer().say(line + "\n");
        loop.advance(0);
    }

    /** A frame of telemetry comes: its data as JSON. */
    Telemetry frame(long beacon, String data) {
        say("{\"name\": \"up.telemetry.update\", \"data\": " + data + ", \"beacon\": " + beacon
                + "}");
        return frames.get(frames.size() - 1);
    }

    /** Frames arrive each 100 ms for that time; the last one arrives now. */
    long fly(long firstBeacon, int count) {
        for (int each = 0; each < count; each++) {
            loop.advance(100);
            frame(firstBeacon + each, "{}");
        }
        return firstBeacon + count - 1;
    }

    /** Returns the messages sent since the last call. */
    List<GeneralMessage> sent() {
        final List<GeneralMessage> messages = new ArrayList<>();
        for (String line : peer().written().split("\n")) {
            if (line.startsWith("{")) {
                try {
                    messages.add(GeneralMessage.read(line.getBytes(ScriptedNetwork.UTF_8),
                            line.length()));
                } catch (MalformedException fault) {
                    throw new AssertionError(line, fault);
                }
            }
        }
        return messages;
    }

    /** Returns the one Command of that name sent since the last call. */
    GeneralMessage sent(String name) {
        GeneralMessage found = null;
        for (GeneralMessage each : sent()) {
            if (each.name.equals(name)) {
                if (found != null) {
                    throw new AssertionError(name + " was sent twice");
                }
                found = each;
            }
        }
        if (found == null) {
            throw new AssertionError(name + " was not sent");
        }
        return found;
    }

    /** The aircraft refuses the ground's automatic request for its gains. */
    void skipGains() {
        for (GeneralMessage each : sent()) {
            if (each.name.equals("arduino.pids.tunings")) {
                nack(each.id, "unavailable", "no board");
            }
        }
    }

    void ack(String id) {
        say("{\"name\": \"up.ack\", \"data\": {\"id\": \"" + id + "\"}}");
    }

    void nack(String id, String code, String reason) {
        say("{\"name\": \"up.nack\", \"data\": {\"id\": \"" + id + "\", \"code\": \"" + code
                + "\", \"reason\": \"" + reason + "\"}}");
    }

    AnswerListener keeping() {
        return answer -> answers.add(answer);
    }

    /** Returns the one answer since the last call. */
    Answer answer() {
        if (answers.size() != 1) {
            throw new AssertionError("not one answer: " + answers);
        }
        return answers.remove(0);
    }

    /** Returns the codes of the events. */
    List<String> events() {
        final List<String> codes = new ArrayList<>();
        for (Event each : ground.events().snapshot().events) {
            codes.add(each.code);
        }
        return codes;
    }

    @SuppressWarnings("unchecked")
    static Map<String, Object> json(String text) {
        try {
            return (Map<String, Object>) Json.parse(text);
        } catch (MalformedException fault) {
            throw new AssertionError(text, fault);
        }
    }

    static Telemetry telemetry(String data, long nowMs) {
        return Telemetry.of(new LinkedHashMap<>(json(data)), 1L, nowMs, 0);
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
        changes++;
    }
}
