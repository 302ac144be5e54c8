package org.raspilot.up.virtual_phone;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.BaseTelemetryHandler;
import org.raspilot.up.ground.GroundSide;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.loop.Loop;

/** Prints the wanted values of every frame, by the library's own handler of telemetry. */
final class ConsoleTelemetry extends BaseTelemetryHandler<Map<String, Object>> {
    private final GroundSide ground;
    private final List<String> paths;
    private final Loop loop;
    private final EventWriter words;

    /** Takes the wanted values, as paths. */
    ConsoleTelemetry(GroundSide ground, List<String> paths, Loop loop, EventWriter words) {
        super(ground);
        this.ground = ground;
        this.paths = paths;
        this.loop = loop;
        this.words = words;
    }

    @Override
    protected Map<String, Object> read(Telemetry telemetry) {
        Map<String, Object> values = new LinkedHashMap<>();
        for (String path : paths) {
            values.put(path, value(telemetry, path));
        }
        return values;
    }

    @Override
    protected void onTelemetry(Map<String, Object> values, Age age) {
        long nowMs = loop.nowMs();
        Map<String, Object> event =
                EventWriter.event("telemetry", "beacon", ground.telemetry().beacon);
        event.put("way_ms", age.transitMs);
        event.put("age_ms", age.frameMs(nowMs));
        event.put("is_stale", age.isSilent(nowMs));
        event.put("values", values);
        words.write(event);
    }

    private static Object value(Telemetry telemetry, String path) {
        Object found = telemetry.number(path);
        if (found == null) {
            found = telemetry.flag(path);
        }
        return found == null ? telemetry.text(path) : found;
    }
}
