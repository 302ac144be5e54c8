package org.raspilot.up.virtual_phone;

import java.util.Arrays;
import java.util.Collections;
import java.util.Iterator;
import java.util.List;
import org.raspilot.up.ground.GroundSettings;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsIdentity;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;
import org.raspilot.up.wire.ProxyRole;

/**
 * The options of the ground console: {@code --proxy HOST:PORT} or {@code --direct HOST:PORT},
 * {@code --aircraft NAME}, {@code --seat command|listen}, {@code --pairing TEXT}, {@code --tls
 * FOLDER}, {@code --values PATH,PATH} to print.
 */
final class ConsoleOptions {
    final GroundSettings settings;
    final List<String> values;

    private ConsoleOptions(GroundSettings settings, List<String> values) {
        this.settings = settings;
        this.values = values;
    }

    /** Returns the options; raises OptionException with a sentence for a wrong one. */
    static ConsoleOptions read(String[] arguments) throws OptionException {
        String[] place = {"127.0.0.1", Integer.toString(GroundSettings.PROXY_PORT)};
        String aircraft = "default";
        ProxyRole seat = ProxyRole.COMMAND;
        boolean isDirect = false;
        Pairing pairing = null;
        TlsIdentity tls = null;
        List<String> values = Collections.singletonList("flight_mode");
        Iterator<String> words = Arrays.asList(arguments).iterator();
        while (words.hasNext()) {
            String name = words.next();
            String value = OptionParser.value(name, words);
            switch (name) {
                case "--proxy":
                case "--direct":
                    place = OptionParser.parts(name, value, 2, "HOST:PORT");
                    isDirect = name.equals("--direct");
                    break;
                case "--aircraft":
                    aircraft = value;
                    break;
                case "--seat":
                    seat = ProxyRole.ofWord(value);
                    break;
                case "--pairing":
                    pairing = Pairing.parse(value);
                    break;
                case "--tls":
                    tls = OptionParser.tls(value);
                    break;
                case "--values":
                    values = Arrays.asList(value.split(","));
                    break;
                default:
                    throw OptionParser.unknown(name);
            }
        }
        return new ConsoleOptions(new GroundSettings(place[0],
                OptionParser.port("port", place[1]), aircraft, seat, isDirect)
                .withPairing(pairing).withTls(tls), values);
    }
}
