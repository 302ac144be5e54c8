package org.raspilot.up.virtual_phone;

import java.util.Arrays;
import java.util.Collections;
import java.util.Iterator;
import java.util.Locale;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/**
 * The options of the virtual phone: {@code --raspberry HOST:GENERAL:ORIENTATION} (default
 * 127.0.0.1:50001:50000), or {@code --discover HOST:PORT}, or {@code --runner HOST:PORT};
 * {@code --aircraft NAME}, {@code --pairing TEXT} and {@code --tls FOLDER} for the runner, {@code
 * --orientation off|tcp|udp}, {@code --orientation-hz N}.
 */
final class PhoneOptions {
    private PhoneOptions() {
    }

    /** Returns the options; raises OptionException with a sentence for a wrong one. */
    static AirborneSettings read(String[] arguments) throws OptionException {
        AirborneSettings.Builder settings = new AirborneSettings.Builder()
                .host("127.0.0.1").aircraft("default").orientation(OrientationTransport.OFF);
        String way = "";
        Iterator<String> words = Arrays.asList(arguments).iterator();
        while (words.hasNext()) {
            String name = words.next();
            if (name.equals("--discover") || name.equals("--runner")) {
                if (!way.isEmpty() && !way.equals(name)) {
                    throw new OptionException(way + " and " + name + " exclude each other");
                }
                way = name;
            }
            read(settings, name, OptionParser.value(name, words));
        }
        try {
            return settings.build();
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
            case "--pairing":
                settings.pairing(Pairing.parse(value));
                break;
            case "--tls":
                settings.runnerTls(OptionParser.tls(value));
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
