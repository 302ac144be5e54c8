package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.junit.Test;
import org.raspilot.up.ground.TelemetryText.TelemetryRow;

/** All telemetry as rows. */
public final class TelemetryTextTest {
    private static List<String> rows(String data) {
        final String[] texts = new String[TelemetryText.rows(
                GroundBench.telemetry(data, 0)).size()];
        int place = 0;
        for (TelemetryRow each : TelemetryText.rows(GroundBench.telemetry(data, 0))) {
            texts[place++] = each.toString();
        }
        return Arrays.asList(texts);
    }

    @Test
    public void eachValueHasItsPathTextAndUnit() {
        assertEquals(Arrays.asList("orientation.roll 3.5 deg", "orientation.yaw -0.2 deg",
                "rates.roll 12 deg/s", "rx.throttle 1500 us", "altitude 12.3 m", "armed no",
                "altitude_required --", "vetoes no receiver, 2", "flight_mode FBW",
                "location.latitude 49.123457 deg", "android.batteryLevel 70 %",
                "age_ms.flight 20 ms", "load.panic yes", "system.providers none"),
                rows("{\"orientation\": {\"roll\": 3.5, \"yaw\": -0.25},"
                + " \"rates\": {\"roll\": 12.0}, \"rx\": {\"throttle\": 1500},"
                + " \"altitude\": 12.34567, \"armed\": false, \"altitude_required\": null,"
                + " \"vetoes\": [\"no receiver\", 2], \"flight_mode\": \"FBW\","
                + " \"location\": {\"latitude\": 49.12345678},"
                + " \"android\": {\"batteryLevel\": 70}, \"age_ms\": {\"flight\": 20},"
                + " \"load\": {\"panic\": true}, \"system\": {\"providers\": []}}"));
    }

    @Test
    public void fieldsOfUnknownCogsAreShownAsWell() {
        assertEquals(Arrays.asList("wind.speed 4.2", "wind.gusts.peak 9",
                "wind.list 1, {...}, yes", "wind.none none"),
                rows("{\"wind\": {\"speed\": 4.2, \"gusts\": {\"peak\": 9},"
                + " \"list\": [1, {\"a\": 2}, true], \"none\": {}}}"));
    }

    @Test
    public void hostileFramesStayReadable() {
        assertEquals(Arrays.asList("a[31m b c"), rows("{\"a\\u001b[31m\": \"b\\nc\"}"));
        assertEquals(Arrays.asList("big 1.0E300", "small 1.0E-9", "zero 0"),
                rows("{\"big\": 1e300, \"small\": 1e-9, \"zero\": 0.0}"));
        final Map<String, Object> many = new LinkedHashMap<>();
        for (int each = 0; each < 2000; each++) {
            many.put("k" + each, (long) each);
        }
        assertEquals(TelemetryText.MAX_ROWS,
                TelemetryText.rows(Telemetry.of(many, null, 0, 0)).size());
        final StringBuilder list = new StringBuilder("{\"list\": [0");
        for (int each = 1; each < 300; each++) {
            list.append(", ").append(each);
        }
        assertTrue(rows(list + "]}").get(0).endsWith("14, 15, and 284 more"));
    }
}
