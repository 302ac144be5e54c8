package org.raspilot.up.virtual_phone;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.ground.GroundSettings;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;
import org.raspilot.up.wire.ProxyRole;

/** The command line options of the ground console. */
final class ConsoleOptions {
    /** What {@code --help} prints. */
    static final String HELP = ""
            + "usage: java -cp JARS org.raspilot.up.virtual_phone.GroundConsole [options]\n"
            + "\n"
            + "A ground station without a screen: the Up Library on the JVM. Telemetry, seat and\n"
            + "answers leave as JSON lines, Commands come as JSON lines on standard input, with\n"
            + "which it ends.\n"
            + "\n"
            + "  --proxy HOST:PORT      through a proxy; default 127.0.0.1:3004\n"
            + "  --direct HOST:PORT     straight to an aircraft that answers no hello\n"
            + "  --aircraft NAME        which of the proxy's; default 'default'\n"
            + "  --seat command|listen  what to ask for at first; default command\n"
            + "  --values PATH,PATH     what to print of telemetry, as orientation.roll,altitude\n"
            + "  --help                 this text\n"
            + "\n"
            + "try: (sleep 2; echo '{\"send\": \"up.telemetry.frequency\","
            + " \"data\": {\"frequency\": 50}}';\n"
            + "      sleep 3) | java ...\n"
            + "The lines are described in GroundConsole.java.\n"
            + "Exit status: 0 when its input has ended, 2 for wrong options.\n";

    /** The peer; null with {@link #wantsHelp}. */
    final GroundSettings settings;
    final List<String> values;
    /** Whether to print only the help. */
    final boolean wantsHelp;

    private ConsoleOptions(GroundSettings settings, List<String> values, boolean wantsHelp) {
        this.settings = settings;
        this.values = Collections.unmodifiableList(values);
        this.wantsHelp = wantsHelp;
    }

    /** Returns the options; raises OptionException with a sentence for a wrong one. */
    static ConsoleOptions read(String[] arguments) throws OptionException {
        String host = "127.0.0.1";
        int port = GroundSettings.PROXY_PORT;
        String aircraft = GroundSettings.DEFAULT_AIRCRAFT;
        ProxyRole seat = ProxyRole.COMMAND;
        boolean isDirect = false;
        boolean wantsHelp = false;
        List<String> values = new ArrayList<>(Arrays.asList("flight_mode"));
        for (int at = 0; at < arguments.length; at++) {
            String name = arguments[at];
            if ("--help".equals(name) || "-h".equals(name)) {
                wantsHelp = true;
                continue;
            }
            if (++at == arguments.length) {
                throw OptionParser.unknown(name, true);
            }
            String value = arguments[at];
            if ("--proxy".equals(name) || "--direct".equals(name)) {
                String[] parts = OptionParser.parts(name, value, 2, "HOST:PORT");
                host = parts[0];
                port = OptionParser.port(name, parts[1]);
                isDirect = "--direct".equals(name);
            } else if ("--aircraft".equals(name)) {
                aircraft = value;
            } else if ("--seat".equals(name)) {
                seat = ProxyRole.ofWord(value);
                if (seat == null || seat == ProxyRole.AIR) {
                    throw new OptionException("--seat '" + value + "' is not command or listen");
                }
            } else if ("--values".equals(name)) {
                values = Arrays.asList(value.split(","));
            } else {
                throw OptionParser.unknown(name, false);
            }
        }
        try {
            return new ConsoleOptions(new GroundSettings(host, port, aircraft, seat, isDirect),
                    values, wantsHelp);
        } catch (IllegalArgumentException wrong) {
            throw new OptionException(wrong.getMessage());
        }
    }
}
