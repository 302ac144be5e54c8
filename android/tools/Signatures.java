import java.io.BufferedReader;
import java.io.File;
import java.io.FileInputStream;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.nio.charset.Charset;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.codehaus.mojo.animal_sniffer.SignatureBuilder;
import org.codehaus.mojo.animal_sniffer.SignatureChecker;
import org.codehaus.mojo.animal_sniffer.logging.Logger;

/**
 * Checks by Animal Sniffer that classes call only what an Android level provides.
 *
 * <p>{@code build SIGNATURE JAR...} records the API of the jars; {@code check SIGNATURE IGNORED
 * ALLOWED JAR...} checks the jars against it; {@code --} starts another check. IGNORED are
 * packages, separated by commas, that are not checked; ALLOWED is a file with the references (one a
 * line, as this program prints them, # for a comment) that are right although the signature lacks
 * them, or {@code -}. An allowed reference that does not occur is reported too, so that the list
 * stays true. Exits with 1 if anything is reported.
 */
public final class Signatures {
    private static final String SAID = "Undefined reference: ";

    private Signatures() {}

    public static void main(String[] arguments) throws IOException {
        List<String> words = Arrays.asList(arguments);
        if (arguments[0].equals("build")) {
            build(arguments[1], words.subList(2, words.size()));
            return;
        }
        boolean clean = true;
        List<String> rest = words.subList(1, words.size());
        while (!rest.isEmpty()) {
            int end = rest.contains("--") ? rest.indexOf("--") : rest.size();
            clean &= check(rest.get(0), rest.get(1), rest.get(2), rest.subList(3, end));
            rest = rest.subList(Math.min(end + 1, rest.size()), rest.size());
        }
        if (!clean) {
            System.exit(1);
        }
    }

    private static void build(String signature, List<String> jars) throws IOException {
        Told told = new Told(new HashSet<>());
        SignatureBuilder builder = new SignatureBuilder(new FileOutputStream(signature), told);
        for (String jar : jars) {
            builder.process(new File(jar));
        }
        builder.close();
    }

    private static boolean check(String signature, String ignored, String allowed,
            List<String> jars) throws IOException {
        Set<String> packages = new HashSet<>();
        for (String each : ignored.split(",")) {
            packages.add(each + ".*");
        }
        Told told = new Told(allowed.equals("-") ? new HashSet<>() : lines(allowed));
        for (String jar : jars) {
            InputStream opened = new FileInputStream(signature);
            try {
                SignatureChecker checker = new SignatureChecker(opened, packages, told);
                checker.setSourcePath(Collections.emptyList());
                checker.process(new File(jar));
            } finally {
                opened.close();
            }
        }
        return told.isClean(allowed);
    }

    private static Set<String> lines(String file) throws IOException {
        Set<String> found = new HashSet<>();
        BufferedReader reader = new BufferedReader(
                new InputStreamReader(new FileInputStream(file), Charset.forName("UTF-8")));
        try {
            for (String line = reader.readLine(); line != null; line = reader.readLine()) {
                String reference = line.split("#", 2)[0].trim();
                if (!reference.isEmpty()) {
                    found.add(reference);
                }
            }
        } finally {
            reader.close();
        }
        return found;
    }

    /** The findings of Animal Sniffer, without the allowed ones. */
    private static final class Told implements Logger {
        private final Set<String> allowed;
        private final Set<String> met = new HashSet<>();
        private boolean clean = true;

        Told(Set<String> allowed) {
            this.allowed = allowed;
        }

        /** "Wrote signatures for ...": nothing that anybody waits for. */
        @Override
        public void info(String message) {}

        @Override
        public void info(String message, Throwable cause) {}

        @Override
        public void debug(String message) {}

        @Override
        public void debug(String message, Throwable cause) {}

        @Override
        public void warn(String message) {
            error(message);
        }

        @Override
        public void warn(String message, Throwable cause) {
            error(message + " (" + cause + ")");
        }

        @Override
        public void error(String message, Throwable cause) {
            error(message + " (" + cause + ")");
        }

        @Override
        public void error(String message) {
            int at = message.indexOf(SAID);
            String reference = at < 0 ? message : message.substring(at + SAID.length()).trim();
            if (allowed.contains(reference)) {
                met.add(reference);
            } else {
                clean = false;
                System.err.println(message);
            }
        }

        boolean isClean(String file) {
            for (String each : allowed) {
                if (!met.contains(each)) {
                    clean = false;
                    System.err.println(file + ": nothing refers to " + each);
                }
            }
            return clean;
        }
    }
}
