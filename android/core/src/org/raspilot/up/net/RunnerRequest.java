package org.raspilot.up.net;

import java.util.Map;

/** What a runner is asked for (protocols 8): an aircraft, by a profile, with a configuration. */
public final class RunnerRequest {
    /**
     * Makes a request.
     *
     * @param aircraft 1 to 32 of {@code A-Z a-z 0-9 _ . -}, not beginning with a dot
     * @param profile name of a ready-made configuration on the runner's host; null: none
     * @param configuration files and their keys; null: none
     * @throws IllegalArgumentException with a sentence when the aircraft's name is none
     */
    public RunnerRequest(String aircraft, String profile, Map<String, ?> configuration) {
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        throw new UnsupportedOperationException();
    }
}
