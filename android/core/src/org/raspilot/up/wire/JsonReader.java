package org.raspilot.up.wire;

/** Reads one JSON text. */
final class JsonReader {
    private final String text;

    JsonReader(String text) {
        this.text = text;
    }

    Object read() throws MalformedException {
        throw new MalformedException("not JSON: " + text);
    }
}
