package org.raspilot.up.net;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.wire.Json;

/** A request to a runner (protocols 8): an aircraft, a profile, and the key that signs it. */
public final class RunnerRequest {
    final Pairing pairing;
    /** As JSON in ASCII, without an LF. */
    final String json;

    /**
     * Creates a request.
     *
     * @param aircraft 1 to 32 of {@code A-Z a-z 0-9 _ . -}, not beginning with a dot
     * @param profile name of a ready-made configuration on the runner's host; empty: none
     * @param pairing this device's key of the aircraft; null: the request is plain
     * @throws IllegalArgumentException when the aircraft's name is invalid
     */
    public RunnerRequest(String aircraft, String profile, Pairing pairing) {
        SettingRules.aircraft(aircraft);
        final Map<String, Object> request = new LinkedHashMap<>();
        request.put("aircraft", aircraft);
        if (!profile.isEmpty()) {
            request.put("profile", profile);
        }
        this.pairing = pairing;
        json = Json.write(request);
    }
}
