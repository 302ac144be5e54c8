package org.raspilot.app;

import java.io.IOException;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** A Raspberry Pi's General Message port: it acks requests. */
final class PlayedBoard extends Peer {
    private static final Pattern ID = Pattern.compile("\"id\": \"([^\"]*)\"");

    PlayedBoard() throws IOException {
    }

    @Override
    void onLine(String line) {
        Matcher id = ID.matcher(line);
        if (id.find()) {
            say("{\"name\": \"up.ack\", \"data\": {\"id\": \"" + id.group(1) + "\"}}");
        }
    }

    /** Returns whether a message with that name arrived. */
    boolean hasHeard(String name) {
        for (String line : heard()) {
            if (line.contains("\"name\": \"" + name + "\"")) {
                return true;
            }
        }
        return false;
    }
}
