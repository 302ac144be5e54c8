package org.raspilot.up.virtual_phone;

import java.io.IOException;

/**
 * The airborne phone without a phone: the Up Library's core on the JVM, with simulated sensors.
 *
 * <p>It is a child of whoever simulates an aircraft and ends with its standard input. Both ways go
 * JSON objects, one a line, UTF-8. It logs nothing: what is worth a word is an event.
 *
 * <p><b>Lines in.</b> Every key is optional; several may stand in one line.
 *
 * <pre>
 * "fix": {"latitude", "longitude", "altitude"?, "accuracy"?, "speed"?, "bearing"?}   deg, m, m/s
 * "pressure": 950.12              hPa
 * "rotation": [w, x, y, z]        the device's axes to east, north, up
 * "rate": [x, y, z]               rad/s about the device's axes
 * "battery": 87                   percent
 * "record": {"topic", "content"}  goes out as black_box.record, slowed by Panic Mode as the
 *                                 rest; with --record only
 * "level": "TOP"                  calibrate: so it lies level, that Side to the nose
 * </pre>
 *
 * <p><b>Lines out.</b>
 *
 * <pre>
 * {"event": "wants", "sensor": "fix", "period_ms": 500}    feed it so often, the first at once; 0:
 *                          no more. The sensors are called as the keys above; "record" is wanted
 *                          while there is a link
 * {"event": "connected", "host", "general", "orientation"}
 * {"event": "lost", "reason"}                    the link for Commands is gone, or cannot be made
 * {"event": "says", "text"}                      android.speak
 * {"event": "panic", "delay_ms"}                 0: it is over
 * {"event": "notice", "text"}                    what else is worth a word, in a sentence
 * {"event": "counters", "connections", ...}      the last line
 * </pre>
 *
 * <p><b>Stepped</b> ({@code --stepped}): time and network are the simulator's. Every line in has
 * {@code "t"}, ms, never less than before; the first one starts the phone. It lets the time pass
 * until then, takes the readings, then the events of the network, and answers: events as above, and
 * at last one line {@code {"due": ms or null, "net": [...]}}. Nothing changes before {@code due}
 * unless readings or events come, so nobody needs to step more often. What the network brought is
 * {@code "net"} of a line in, what it is to do {@code "net"} of an answer: lists, in their order.
 * Bytes are texts of ISO 8859-1; an id is a number that is never used again.
 *
 * <pre>
 * to do: ["connect", id, host, port, timeout_ms]  ["write", id, bytes]  ["full", id]  ["close", id]
 *        ["open", id]  ["send", id, bytes, host, port]  ["shut", id]
 * brought: ["connected", id]  ["bytes", id, bytes]  ["room", id, count]  ["closed", id, reason]
 *        ["datagram", id, bytes, host, port]
 * </pre>
 *
 * <p>A connection has room for {@link PipedConnection#ROOM_BYTES}; {@code room} gives back what has
 * left. It may wait for any other line, but for a connection that said {@code full}.
 */
public final class VirtualPhone {
    private static final int WRONG_INPUT = 2;

    private VirtualPhone() {}

    /** Runs until standard input ends; exit status 2 for wrong options. */
    public static void main(String[] arguments) throws IOException {
        PhoneOptions options;
        try {
            options = PhoneOptions.read(arguments);
        } catch (OptionException error) {
            System.err.println("virtual phone: " + error.getMessage());
            System.exit(WRONG_INPUT);
            return;
        }
        if (options.wantsHelp) {
            System.out.print(PhoneOptions.HELP);
            return;
        }
        Words words = new Words(System.out, !options.isStepped);
        PhoneSide phone = new PhoneSide(options, words);
        if (options.isStepped) {
            new SteppedRun(phone, words).run(System.in);
        } else {
            new LoopProgram("virtual phone", words).run(System.in, phone);
        }
    }
}
