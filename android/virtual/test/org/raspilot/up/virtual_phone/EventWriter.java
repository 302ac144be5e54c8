package org.raspilot.up.virtual_phone;

import java.io.BufferedOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.Charset;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.Json;

/** The output of a program: JSON objects, one a line; may be used on any thread. */
final class EventWriter {
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private final OutputStream out;

    /** Prints everything to {@code out}, which has no other writer. */
    EventWriter(OutputStream out) {
        this.out = new BufferedOutputStream(out, 16384);
    }

    /** Starts an event; more fields may be put into it. */
    static Map<String, Object> event(String name, String field, Object value) {
        Map<String, Object> fields = new LinkedHashMap<>();
        fields.put("event", name);
        fields.put(field, value);
        return fields;
    }

    synchronized void write(Map<String, Object> fields) {
        try {
            out.write(Json.write(fields).getBytes(ASCII));
            out.write('\n');
            out.flush();
        } catch (IOException error) {
            // The reader is gone: standard input ends, and so does the program.
            return;
        }
    }

    void notice(String code, String sentence) {
        final Map<String, Object> event = event("notice", "code", code);
        event.put("text", sentence);
        write(event);
    }

    void fault(Throwable fault) {
        StackTraceElement[] trace = fault.getStackTrace();
        notice("fault", "a fault: " + fault + (trace.length > 0 ? " at " + trace[0] : ""));
    }
}
