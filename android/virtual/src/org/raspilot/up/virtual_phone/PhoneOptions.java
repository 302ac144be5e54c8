package org.raspilot.up.virtual_phone;

import java.util.Arrays;
import java.util.Collections;
import java.util.Iterator;
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
            + "  --help                                 this text\n"
            + "\n"
            + "try: (echo '{\"battery\": 87}'; sleep 5)"
            + " | java ... --raspberry 127.0.0.1:50001:50000\n"
            + "The lines are described in VirtualPhone.java.\n"
            + "Exit status: 0 when its input has ended, 2 for wrong options.\n";

    /** How the airborne side is to be. */
    final AirborneSettings settings;

    /** Whether there is something that the black box is to write. */
    final boolean isRecording;

    /** Whether to print only the help. */
    final boolean wantsHelp;

    private PhoneOptions(AirborneSettings settings, boolean isRecording, boolean wantsHelp) {
        this.settings = settings;
        this.isRecording = isRecording;
        this.wantsHelp = wantsHelp;
    }

    /** Returns the options; raises OptionException with a sentence for a wrong one. */
    static PhoneOptions read(String[] arguments) throws OptionException {
        AirborneSettings.Builder settings = new AirborneSettings.Builder()
                .host("127.0.0.1").aircraft("default").orientation(OrientationTransport.OFF);
        boolean isRecording = false;
        boolean wantsHelp = false;
        String way = "";
        Iterator<String> words = Arrays.asList(arguments).iterator();
        while (words.hasNext()) {
            String name = words.next();
            switch (name) {
                case "--record":
                    isRecording = true;
                    break;
                case "--help":
                case "-h":
                    wantsHelp = true;
                    break;
                case "--discover":
                case "--runner":
                    if (!way.isEmpty() && !way.equals(name)) {
                        throw new OptionException(way + " and " + name + " exclude each other");
                    }
                    way = name;
                    read(settings, name, OptionParser.value(name, words));
                    break;
                default:
                    read(settings, name, OptionParser.value(name, words));
            }
        }
        try {
            return new PhoneOptions(settings.build(), isRecording, wantsHelp);
        } catch (IllegalArgumentException error) {
            throw new OptionException(error.getMessage());
        }
    }

    private static void read(AirborneSettings.Builder settings, String name, String value)
            throws OptionException {
        String[] parts;
        switch (name) {
            case "--aircraft":
                settings.aircraft(value);
                break;
            case "--raspberry":
                parts = OptionParser.parts(name, value, 3, "HOST:GENERAL:ORIENTATION");
                settings.host(parts[0]);
                settings.generalPort(OptionParser.port(name, parts[1]));
                settings.orientationPort(OptionParser.port(name, parts[2]));
                break;
            case "--discover":
                parts = OptionParser.parts(name, value, 2, "HOST:PORT");
                settings.host("");
                settings.discoveryHosts(Collections.singletonList(parts[0]));
                settings.discoveryPort(OptionParser.port(name, parts[1]));
                break;
            case "--runner":
                parts = OptionParser.parts(name, value, 2, "HOST:PORT");
                settings.mode(AirborneMode.BLACK_BOX);
                settings.runnerHost(parts[0]);
                settings.runnerPort(OptionParser.port(name, parts[1]));
                break;
            case "--orientation":
                OrientationTransport transport = transport(value);
                settings.orientation(transport);
                settings.redundantOrientation(transport != OrientationTransport.OFF);
                break;
            case "--orientation-hz":
                settings.orientationHz(OptionParser.number(name, value, 1, 1000));
                break;
            case "--mounting":
                try {
                    settings.mounting(Mounting.fromText(value));
                } catch (IllegalArgumentException error) {
                    throw new OptionException("--mounting: " + error.getMessage());
                }
                break;
            default:
                throw OptionParser.unknown(name);
        }
    }

    private static OrientationTransport transport(String value) throws OptionException {
        for (OrientationTransport each : OrientationTransport.values()) {
            if (each.name().toLowerCase(Locale.ROOT).equals(value)) {
                return each;
            }
        }
        throw new OptionException("--orientation '" + value + "' is not off, tcp or udp");
    }
}
