package org.raspilot.up.virtual_phone;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.Paths;
import java.util.Iterator;
import org.raspilot.up.tls.TlsException;
import org.raspilot.up.tls.TlsIdentity;

/** Reads the values of options; each raises OptionException with a sentence. */
final class OptionParser {
    private OptionParser() {}

    /** Splits at the last colons: the part before them may contain colons too. */
    static String[] parts(String name, String value, int count, String form)
            throws OptionException {
        String[] found = new String[count];
        String rest = value;
        for (int at = count - 1; at > 0; at--) {
            int colon = rest.lastIndexOf(':');
            if (colon <= 0) {
                throw new OptionException(name + " '" + value + "' is not " + form);
            }
            found[at] = rest.substring(colon + 1);
            rest = rest.substring(0, colon);
        }
        found[0] = rest;
        return found;
    }

    static String value(String name, Iterator<String> words) throws OptionException {
        if (!words.hasNext()) {
            throw new OptionException(
                    name + ": no such option, or its value is missing");
        }
        return words.next();
    }

    /** Returns a port, 1 to 65535. */
    static int port(String name, String value) throws OptionException {
        return number(name + ": a port", value, 1, 65535);
    }

    static int number(String what, String value, int least, int most) throws OptionException {
        try {
            int found = Integer.parseInt(value);
            if (found >= least && found <= most) {
                return found;
            }
        } catch (NumberFormatException error) {
            // As one that is out of range.
        }
        throw new OptionException(what + " is " + least + " to " + most + ", not '" + value + "'");
    }

    /** Returns what the files of a folder of {@code up certificates device} hold. */
    static TlsIdentity tls(String folder) throws OptionException {
        final StringBuilder text = new StringBuilder();
        for (String each : new String[] {"ca", "certificate", "key", "revoked"}) {
            final Path file = Paths.get(folder, each + ".pem");
            try {
                if (Files.exists(file)) {
                    text.append(new String(Files.readAllBytes(file), StandardCharsets.US_ASCII));
                }
            } catch (IOException error) {
                throw new OptionException("--tls " + file + ": " + error);
            }
        }
        try {
            return TlsIdentity.parse(text.toString());
        } catch (TlsException error) {
            throw new OptionException(error.code, "--tls " + folder + ": " + error.getMessage());
        }
    }

    static OptionException unknown(String name) {
        return new OptionException(name + ": no such option");
    }

    /** Invalid input of a program: one sentence for the user. */
    static final class OptionException extends Exception {
        private static final long serialVersionUID = 1;

        final String code;

        OptionException(String sentence) {
            this("invalid_input", sentence);
        }

        OptionException(String code, String sentence) {
            super(sentence);
            this.code = code;
        }
    }
}
