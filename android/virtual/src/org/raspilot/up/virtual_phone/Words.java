package org.raspilot.up.virtual_phone;

import java.io.BufferedOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.Charset;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.Json;

/** What a program says: JSON objects, one a line; may be used on any thread. */
final class Words {
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private final OutputStream out;
    private final boolean isPrompt;

    /**
     * Says everything to {@code out}, which nobody else writes to.
     *
     * @param isPrompt whether each line is to be heard at once
     */
    Words(OutputStream out, boolean isPrompt) {
        this.out = new BufferedOutputStream(out, 16384);
        this.isPrompt = isPrompt;
    }

    /** Returns what is said of an exception that nobody expected. */
    static String faultText(Throwable fault) {
        StackTraceElement[] trace = fault.getStackTrace();
        return "a fault: " + fault + (trace.length > 0 ? " at " + trace[0] : "");
    }

    /** Begins an event of that name; more fields may be put into it. */
    static Map<String, Object> event(String name) {
        Map<String, Object> fields = new LinkedHashMap<String, Object>();
        fields.put("event", name);
        return fields;
    }

    /** Returns an event with one field. */
    static Map<String, Object> event(String name, String field, Object value) {
        Map<String, Object> fields = event(name);
        fields.put(field, value);
        return fields;
    }

    /** Says it; who listens may hear of it only after {@link #flush}. */
    synchronized void say(Map<String, Object> fields) {
        try {
            out.write(Json.write(fields).getBytes(ASCII));
            out.write('\n');
            if (isPrompt) {
                out.flush();
            }
        } catch (IOException error) {
            // Nobody listens any more: standard input ends, and so does the program.
            return;
        }
    }

    /** Says a sentence. */
    void notice(String sentence) {
        say(event("notice", "text", sentence));
    }

    /** Lets everything that was said be heard. */
    synchronized void flush() {
        try {
            out.flush();
        } catch (IOException error) {
            // As above.
            return;
        }
    }
}
