package org.raspilot.up.virtual_phone;

import java.util.Collections;
import java.util.Locale;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** The command line options of the virtual phone. */
final class PhoneOptions {
    /** What {@code --help} prints. */
    static final String HELP = ""
            + "usage: java -cp up-core.jar:virtual-phone.jar"
            + " org.raspilot.up.virtual_phone.VirtualPhone [options]\n"
            + "\n"
            + "The airborne phone without a phone: the Up Library on the JVM. Its sensors come as\n"
            + "JSON lines on standard input, what it hears leaves as JSON lines; it ends with its\n"
            + "input. The simulator does all this: 'up-sim start --phone java', 'make run'.\n"
            + "\n"
            + "where Raspilot is (one of these):\n"
            + "  --raspberry HOST:GENERAL:ORIENTATION   there; default 127.0.0.1:50001:50000\n"
            + "  --discover HOST:PORT                   its host by Discovery, asked there\n"
            + "  --runner HOST:PORT                     a runner's, asked to spawn it (Black Box)\n"
            + "  --aircraft NAME                        for which aircraft; default 'default'\n"
            + "how:\n"
            + "  --orientation off|tcp|udp              also sends its attitude; default off\n"
            + "  --orientation-hz N                     50 to 200 a second; default 50\n"
            + "  --mounting 'W X Y Z'                   how it lies: a rotation from nose, right\n"
            + "                                         wing, down to right edge, top edge, out\n"
            + "                                         of the screen; default flat, top ahead\n"
            + "  --record                               it passes \"record\" on to the black box\n"
            + "  --seed N                               of what a stepped phone draws; default 1\n"
            + "  --stepped                              time and network are the simulator's\n"
            + "  --help                                 this text\n"
            + "\n"
            + "try: (echo '{\"battery\": 87}'; sleep 5)"
            + " | java ... --raspberry 127.0.0.1:50001:50000\n"
            + "The lines are described in VirtualPhone.java.\n"
            + "Exit status: 0 when its input has ended, 2 for wrong options.\n";

    /** How the airborne side is to be. */
    final AirborneSettings settings;
    final long seed;
    /** Whether time and network are the simulator's. */
    final boolean isStepped;
    /** Whether there is something that the black box is to write. */
    final boolean isRecording;
    /** Whether to print only the help. */
    final boolean wantsHelp;

    private PhoneOptions(Reader reader) throws OptionException {
        seed = reader.seed;
        isStepped = reader.isStepped;
        isRecording = reader.isRecording;
        wantsHelp = reader.wantsHelp;
        try {
            settings = reader.settings.build();
        } catch (IllegalArgumentException error) {
            throw new OptionException(error.getMessage());
        }
    }

    /** Returns the options; raises OptionException with a sentence for a wrong one. */
    static PhoneOptions read(String[] arguments) throws OptionException {
        Reader reader = new Reader();
        for (int at = 0; at < arguments.length; at++) {
            at += reader.readOption(arguments[at], at + 1 < arguments.length ? arguments[at
                    + 1] : null);
        }
        return new PhoneOptions(reader);
    }

    /** Takes one option after the other. */
    private static final class Reader {
        private final AirborneSettings.Builder settings = new AirborneSettings.Builder();
        private String way = "";
        private long seed = 1;
        private boolean isStepped;
        private boolean isRecording;
        private boolean wantsHelp;

        Reader() {
            settings.host("127.0.0.1");
            settings.aircraft("default");
            settings.orientation(OrientationTransport.OFF);
        }

        /** Takes an option and returns the number of its arguments. */
        int readOption(String name, String value) throws OptionException {
            if ("--stepped".equals(name)) {
                isStepped = true;
                return 0;
            }
            if ("--record".equals(name)) {
                isRecording = true;
                return 0;
            }
            if ("--help".equals(name) || "-h".equals(name)) {
                wantsHelp = true;
                return 0;
            }
            if (value == null) {
                throw OptionParser.unknown(name, true);
            }
            if (!readEndpoint(name, value) && !readMode(name, value)) {
                throw OptionParser.unknown(name, false);
            }
            return 1;
        }

        private boolean readEndpoint(String name, String value) throws OptionException {
            if ("--aircraft".equals(name)) {
                settings.aircraft(value);
                return true;
            }
            if ("--raspberry".equals(name)) {
                String[] parts = OptionParser.parts(name, value, 3, "HOST:GENERAL:ORIENTATION");
                settings.host(parts[0]);
                settings.generalPort(OptionParser.port(name, parts[1]));
                settings.orientationPort(OptionParser.port(name, parts[2]));
                return true;
            }
            if ("--discover".equals(name)) {
                String[] parts = OptionParser.parts(name, value, 2, "HOST:PORT");
                settings.host("");
                settings.discoveryHosts(Collections.singletonList(parts[0]));
                settings.discoveryPort(OptionParser.port(name, parts[1]));
                choose(name);
                return true;
            }
            if ("--runner".equals(name)) {
                String[] parts = OptionParser.parts(name, value, 2, "HOST:PORT");
                settings.mode(AirborneMode.BLACK_BOX);
                settings.runnerHost(parts[0]);
                settings.runnerPort(OptionParser.port(name, parts[1]));
                choose(name);
                return true;
            }
            return false;
        }

        private void choose(String name) throws OptionException {
            if (!way.isEmpty() && !way.equals(name)) {
                throw new OptionException(way + " and " + name + " exclude each other");
            }
            way = name;
        }

        private boolean readMode(String name, String value) throws OptionException {
            if ("--orientation".equals(name)) {
                OrientationTransport transport = transport(value);
                settings.orientation(transport);
                settings.redundantOrientation(transport != OrientationTransport.OFF);
            } else if ("--orientation-hz".equals(name)) {
                settings.orientationHz((int) OptionParser.number(name, value, 1, 1000));
            } else if ("--mounting".equals(name)) {
                settings.mounting(mounting(value));
            } else if ("--seed".equals(name)) {
                seed = OptionParser.number(name, value, 0, Integer.MAX_VALUE);
            } else {
                return false;
            }
            return true;
        }

        private static OrientationTransport transport(String value) throws OptionException {
            for (OrientationTransport each : OrientationTransport.values()) {
                if (each.name().toLowerCase(Locale.ROOT).equals(value)) {
                    return each;
                }
            }
            throw new OptionException("--orientation '" + value + "' is not off, tcp or udp");
        }

        private static Mounting mounting(String value) throws OptionException {
            try {
                return Mounting.fromText(value);
            } catch (IllegalArgumentException error) {
                throw new OptionException("--mounting: " + error.getMessage());
            }
        }
    }
}
