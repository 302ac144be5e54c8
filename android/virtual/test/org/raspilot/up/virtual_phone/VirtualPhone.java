package org.raspilot.up.virtual_phone;

import java.io.IOException;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/**
 * The airborne phone without a phone: the Up Library's core on the JVM, with simulated sensors.
 *
 * <p>It is a child process of a test and ends with its standard input. Both directions carry
 * JSON objects, one a line, UTF-8. It writes no log, only events.
 *
 * <p><b>Lines in.</b> Every key is optional; one line may have several.
 *
 * <pre>
 * "fix": {"latitude", "longitude", "altitude"?, "accuracy"?, "speed"?, "bearing"?}   deg, m, m/s
 * "pressure": 950.12              hPa
 * "rotation": [w, x, y, z]        the device's axes to east, north, up
 * "rate": [x, y, z]               rad/s about the device's axes
 * "battery": 87                   percent
 * </pre>
 *
 * <p><b>Lines out.</b>
 *
 * <pre>
 * {"event": "wants", "sensor": "fix", "period_ms": 500}    send it at this period, the first
 *                          immediately; 0: stop. The sensors are named as the keys above
 * {"event": "connected", "host", "general", "orientation"}
 * {"event": "lost", "code", "reason"}                   the link for Commands is lost, or failed
 * {"event": "says", "text"}                      android.speak
 * {"event": "panic", "delay_ms"}                 0: it is over
 * {"event": "notice", "code", "text"}            anything else to report, in a sentence
 * {"event": "counters", "connections", ...}      the last line
 * </pre>
 */
public final class VirtualPhone {
    private static final int WRONG_INPUT = 2;

    private VirtualPhone() {}

    /** Runs until standard input ends; exit status 2 for wrong options. */
    public static void main(String[] arguments) throws IOException {
        AirborneSettings settings;
        try {
            settings = PhoneOptions.read(arguments);
        } catch (OptionException error) {
            System.err.println("virtual phone: " + error.getMessage());
            System.exit(WRONG_INPUT);
            return;
        }
        EventWriter words = new EventWriter(System.out);
        new LoopProgram("virtual phone", words).run(System.in, new PhoneSide(settings, words));
    }
}
