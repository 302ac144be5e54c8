package org.raspilot.up.virtual_phone;

import java.io.IOException;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/**
 * A ground station without a screen: the Up Library's ground side on the JVM, for programs.
 *
 * <p>It ends with its standard input. Both directions carry JSON objects, one a line, UTF-8.
 *
 * <p><b>Lines in.</b>
 *
 * <pre>
 * {"send": NAME, "data": {...}, "tag": "1"}   a Command; its answer has the tag again. It echoes
 *                                    the newest frame's beacon, as a screen that shows all
 * {"gains": "ask" | "undo" | {"ratePIDs", "stabPIDs", "navPIDs"?}, "tag"?}
 * {"seat": "request" | "release" | {"give": 2}}
 * {"options": "--proxy ..."}                  connect again, as if started with these options
 * </pre>
 *
 * <p><b>Lines out.</b>
 *
 * <pre>
 * {"event": "telemetry", "beacon", "way_ms", "age_ms", "is_stale", "values": {PATH: value or null}}
 *                             every frame, by a handler of the Command (--values: which paths)
 * {"event": "status", "link", "sentence", "seat", "standing", "holder", "asked_by", "online",
 *  "role", "security", "tls", "code", "key_fault", "refused", "tune_in_flight", "reason",
 *  "rejection"}
 *                             whenever it changed
 * {"event": "answer", "tag", "name", "outcome", "code", "reason", "round_trip_ms", "data"}
 * {"event": "gains", "flying": {...} or null}            whenever they changed
 * {"event": "notice", "code", "text"}
 * </pre>
 */
public final class GroundConsole {
    private static final int WRONG_INPUT = 2;

    private GroundConsole() {}

    /** Runs until standard input ends; exit status 2 for wrong options. */
    public static void main(String[] arguments) throws IOException {
        ConsoleOptions options;
        try {
            options = ConsoleOptions.read(arguments);
        } catch (OptionException | IllegalArgumentException error) {
            System.err.println("ground console: " + error.getMessage());
            System.exit(WRONG_INPUT);
            return;
        }
        EventWriter words = new EventWriter(System.out);
        new LoopProgram("ground console", words).run(System.in, new ConsoleSide(options, words));
    }
}
