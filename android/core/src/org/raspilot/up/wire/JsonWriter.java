package org.raspilot.up.wire;

/** Writes one JSON text. */
final class JsonWriter {
    String write(Object value) {
        return String.valueOf(value);
    }
}
