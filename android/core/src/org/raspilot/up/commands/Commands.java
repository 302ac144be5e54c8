package org.raspilot.up.commands;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.CommandRegistry.CommandReader;
import org.raspilot.up.wire.GeneralMessage;

/**
 * The Commands that the Up Library knows: their names on the wire, the rules of their fields, and
 * how to create them. Source: docs/protocols.md 4 to 6; {@code tests/android/test_json_agrees.py}
 * compares the rules with Python's.
 */
public final class Commands {
    public static final String ACK = "up.ack";
    public static final String ALTITUDE = "up.altitude.change";
    public static final String ARM = "up.arm";
    public static final String BATTERY = "android.battery";
    public static final String DISARM = "up.disarm";
    public static final String FLIGHT_MODE = "up.flight_mode.set";
    public static final String HEADING = "up.heading.change";
    public static final String LOCATION = "up.location.update";
    public static final String LOCATION_ALIAS = "up.location.change";
    public static final String MARK = "black_box.mark";
    public static final String NACK = "up.nack";
    public static final String PANIC = "up.panic";
    public static final String PANIC_ALIAS = "load_guard.panic";
    public static final String PIDS = "arduino.pids.tunings";
    public static final String RECORD = "black_box.record";
    public static final String SPEAK = "android.speak";
    public static final String TELEMETRY = "up.telemetry.update";
    public static final String TELEMETRY_PERIOD = "up.telemetry.frequency";
    private static final List<String> FIXES = Arrays.asList("2d", "3d", "dgps", "rtk");
    private static final List<String> VALUES = Arrays.asList("actual", "required");
    private static final CommandRegistry BUILTIN = CommandRegistry.builtin();

    private Commands() {
    }

    static void register(CommandRegistry registry) {
        registry.register(ACK, rule(fields -> fields.text("id", GeneralMessage.MAX_ID_LENGTH)));
        registry.register(ALTITUDE, rule(fields -> {
            fields.number("altitude", -1000, 30000);
            fields.choice("mode", VALUES, "actual");
        }));
        registry.register(ARM, rule(fields -> { }));
        registry.register(BATTERY, rule(fields -> fields.number("level", 0, 100)));
        registry.register(DISARM, rule(fields -> { }));
        registry.register(FLIGHT_MODE, rule(fields -> fields.text("mode", 32)));
        registry.register(HEADING, rule(fields -> {
            fields.number("heading", -360, 360);
            fields.choice("mode", VALUES);
        }));
        registry.register(LOCATION, rule(fields -> {
            fields.number("latitude", -90, 90);
            fields.number("longitude", -180, 180);
            fields.optionalNumber("altitude", -1000, 100000);
            fields.optionalNumber("accuracy", 0, Double.MAX_VALUE);
            fields.optionalNumber("speed", 0, Double.MAX_VALUE);
            fields.optionalNumber("bearing", -360, 360);
            // Computed on board; they must only be numbers.
            fields.optionalNumber("distance_from_home", -Double.MAX_VALUE, Double.MAX_VALUE);
            fields.optionalNumber("required_bearing", -Double.MAX_VALUE, Double.MAX_VALUE);
            fields.optionalNumber("age_ms", 0, 60000);
            fields.optionalWhole("satellites", 0, 255);
            fields.optionalChoice("fix", FIXES);
            fields.optionalNumber("pdop", 0, 100);
            fields.optionalNumber("climb", -200, 200);
        }), LOCATION_ALIAS);
        registry.register(MARK, rule(fields -> fields.inkedText("text", 200)));
        registry.register(NACK, rule(fields -> {
            fields.text("id", GeneralMessage.MAX_ID_LENGTH);
            fields.text("code", 32);
            fields.text("reason", 500, "");
            fields.text("detail", 32, "");
        }));
        registry.register(PANIC, rule(fields -> {
            fields.flag("panic");
            fields.number("delay_ms", 0, 10000);
            fields.optionalNumber("utilization", 0, 100);
        }), PANIC_ALIAS);
        registry.register(PIDS, rule(fields -> {
            boolean isRequest = Boolean.TRUE.equals(fields.optionalFlag("request"));
            Map<String, Object> pids = fields.optionalObject("pids");
            if (!isRequest && pids == null) {
                throw new InvalidCommandException("missing", "pids", "or request is needed");
            }
            if (!isRequest) {
                GainSet.ofData(pids);
            }
        }));
        registry.register(RECORD, rule(fields -> {
            fields.topic("topic");
            fields.object("content");
        }));
        registry.register(SPEAK, rule(fields -> fields.filledText("text", 200)));
        registry.register(TELEMETRY, rule(fields -> { }));
        registry.register(TELEMETRY_PERIOD, rule(fields -> fields.number("frequency", 20, 10000)));
    }

    public static BaseCommand ack(String id) {
        return of(ACK, "id", id);
    }

    public static BaseCommand nack(String id, String code, String reason) {
        return of(NACK, "id", id, "code", code, "reason", reason);
    }

    /** Creates a requested flight mode; the aircraft knows which exist. */
    public static BaseCommand flightMode(String mode) {
        return of(FLIGHT_MODE, "mode", mode);
    }

    public static BaseCommand pidsRequest() {
        return of(PIDS, "request", true);
    }

    /** Creates the Command that replaces all gains. */
    public static BaseCommand pids(GainSet gains) {
        return of(PIDS, "pids", gains.toData());
    }

    /** Creates an object for the flight log; the topic is words joined by dots. */
    public static BaseCommand record(String topic, Map<String, ?> content) {
        return of(RECORD, "topic", topic, "content", content);
    }

    /**
     * Creates any Command of pairs of field and value; a pair with the value null is left out.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public static BaseCommand of(String name, Object... pairs) {
        Map<String, Object> data = new LinkedHashMap<>();
        for (int i = 0; i < pairs.length; i += 2) {
            if (pairs[i + 1] != null) {
                data.put((String) pairs[i], pairs[i + 1]);
            }
        }
        return BUILTIN.read(new GeneralMessage(name, data));
    }

    private interface Rule {
        void check(CommandFields fields);
    }

    private static CommandReader rule(Rule rule) {
        return message -> {
            rule.check(new CommandFields(message.data));
            return new BaseCommand(message);
        };
    }
}
