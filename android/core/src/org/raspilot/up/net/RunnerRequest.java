package org.raspilot.up.net;

import java.nio.charset.Charset;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.Json;

/** A request to a runner (protocols 8): an aircraft, a profile, a configuration. */
public final class RunnerRequest {
    /** Bytes of the longest request with its LF. */
    public static final int MAX_LINE_BYTES = 65536;

    private final byte[] line;

    /**
     * Creates a request.
     *
     * @param aircraft 1 to 32 of {@code A-Z a-z 0-9 _ . -}, not beginning with a dot
     * @param profile name of a ready-made configuration on the runner's host, or null
     * @param configuration files and their keys, or null
     * @throws IllegalArgumentException with a sentence when the aircraft's name is invalid, the
     *     configuration cannot be written as JSON, or the request is longer than 64 KiB
     */
    public RunnerRequest(String aircraft, String profile, Map<String, ?> configuration) {
        SettingRules.aircraft("aircraft's name", aircraft);
        final Map<String, Object> request = new LinkedHashMap<>();
        request.put("aircraft", aircraft);
        if (profile != null) {
            request.put("profile", profile);
        }
        if (configuration != null) {
            request.put("configuration", configuration);
        }
        line = (Json.write(request) + "\n").getBytes(Charset.forName("UTF-8"));
        if (line.length > MAX_LINE_BYTES) {
            throw new IllegalArgumentException("the request has " + line.length
                    + " bytes, more than " + MAX_LINE_BYTES);
        }
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        return line.clone();
    }
}
