package org.raspilot.app;

import java.io.IOException;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** A proxy with an aeroplane behind it: seats the ground, acks its Commands, flies a curve. */
final class PlayedProxy extends Peer {
    private static final String TOKEN = "0123456789abcdef0123456789abcdef";
    private static final Pattern ID = Pattern.compile("\"id\": \"([^\"]*)\"");
    private static final double METRES_A_DEGREE = 111195;
    private static final double HOME_LATITUDE = 49.74747;
    private static final double HOME_LONGITUDE = 13.37759;
    private static final String GAINS = "{\"name\": \"arduino.pids.values\", \"data\": {"
            + "\"ratePIDs\": {\"ailerons\": {\"p\": 1.0, \"i\": 0.05, \"d\": 0.01}, "
            + "\"elevator\": {\"p\": 1.2, \"i\": 0.05, \"d\": 0.02}, "
            + "\"rudder\": {\"p\": 0.8, \"i\": 0, \"d\": 0}}, "
            + "\"stabPIDs\": {\"ailerons\": {\"p\": 4.5, \"i\": 0.1, \"d\": 0}, "
            + "\"elevator\": {\"p\": 4, \"i\": 0.1, \"d\": 0}, "
            + "\"rudder\": {\"p\": 1.5, \"i\": 0, \"d\": 0}}}}";

    private static final long PERIOD_MS = 100;

    private long beacon = 4711;
    private int step;
    private boolean isFlying;

    PlayedProxy() throws IOException {
        run("fly", this::flyOn);
    }

    /** Makes the aeroplane send ten frames a second, or none. */
    synchronized void setFlying(boolean isFlyingNow) {
        isFlying = isFlyingNow;
    }

    private void flyOn() throws IOException {
        while (!isClosed()) {
            synchronized (this) {
                if (isFlying) {
                    fly();
                }
            }
            try {
                Thread.sleep(PERIOD_MS);
            } catch (InterruptedException nobody) {
                throw new IOException(nobody);
            }
        }
    }

    @Override
    void onLine(String line) {
        if (line.startsWith("UP1 aircraft=")) {
            say("UP1 ok aircraft=default seat=command token=" + TOKEN);
            say("UP1 seat holder=1");
            say("UP1 aircraft online");
        } else if (line.startsWith("{")) {
            Matcher id = ID.matcher(line);
            if (id.find() && line.contains("\"arduino.pids.tunings\"")
                    && line.contains("\"request\": true")) {
                say(GAINS);
            }
            if (id.reset().find()) {
                say("{\"name\": \"up.ack\", \"data\": {\"id\": \"" + id.group(1) + "\"}}");
            }
        }
    }

    /** Sends the next frame of the flight: 2 m further on a wide curve. */
    synchronized void fly() {
        step++;
        double turnDeg = step * 0.9;
        double radiusM = 130 + 25 * Math.sin(step / 40.0);
        double northM = 60 + radiusM * Math.cos(Math.toRadians(turnDeg));
        double eastM = -40 + radiusM * Math.sin(Math.toRadians(turnDeg));
        double heading = (turnDeg + 90) % 360;
        double altitude = 74 + 9 * Math.sin(step / 30.0);
        say(frame(heading, altitude, HOME_LATITUDE + northM / METRES_A_DEGREE,
                HOME_LONGITUDE + eastM / METRES_A_DEGREE
                        / Math.cos(Math.toRadians(HOME_LATITUDE)),
                Math.hypot(northM, eastM),
                (Math.toDegrees(Math.atan2(-eastM, -northM)) + 360) % 360));
    }

    private String frame(double heading, double altitude, double latitude, double longitude,
            double distance, double bearing) {
        return String.format(java.util.Locale.ROOT, "{\"name\": \"up.telemetry.update\", "
                + "\"beacon\": %d, \"data\": {"
                + "\"orientation\": {\"roll\": %.2f, \"pitch\": %.2f, \"yaw\": %.2f}, "
                + "\"rates\": {\"roll\": 1.4, \"pitch\": -0.8, \"yaw\": 9.1}, "
                + "\"rx\": {\"ailerons\": 1562, \"elevator\": 1471, \"throttle\": 1640, "
                + "\"rudder\": 1500, \"aux1\": 1900, \"aux2\": 1100}, "
                + "\"servo\": {\"ailerons\": 1581, \"elevator\": 1464, \"throttle\": 1640, "
                + "\"rudder\": 1512}, "
                + "\"location\": {\"latitude\": %.7f, \"longitude\": %.7f, \"altitude\": %.1f}, "
                + "\"home\": {\"distance\": %.1f, \"bearing\": %.1f, "
                + "\"altitude\": 310.0, \"time_s\": 41}, \"altitude\": %.1f, "
                + "\"altitude_required\": null, "
                + "\"heading\": {\"actual\": %.1f, \"required\": null}, "
                + "\"android\": {\"connected\": true, \"batteryLevel\": 83}, "
                + "\"arduino\": {\"connected\": true, \"framing\": \"checked\", "
                + "\"switch\": \"AUTO\", \"failsafe\": false, \"receiver_valid\": true, "
                + "\"imu_valid\": true, \"flight_battery_v\": 11.14, "
                + "\"flight_battery_low\": true, \"flight_battery_critical\": false}, "
                + "\"load\": {\"cpu\": 12.0, \"ram\": 31.0, \"panic\": false, \"delay_ms\": 100}, "
                + "\"mode\": \"flight controller\", \"flight_mode\": \"FBW\", "
                + "\"flight_controller\": \"arduino\", \"armed\": true, \"vetoes\": [], "
                + "\"flight_control\": {\"mode\": null, \"selected\": null, \"fallback\": null, "
                + "\"modes\": {\"AUTO\": null, \"LOITER\": null, \"GLIDE\": \"navigation\"}, "
                + "\"board_modes\": [\"FBW\", \"RATE\"]}, "
                + "\"navigation\": {\"latitude\": %.7f, \"longitude\": %.7f, \"height\": 80.4, "
                + "\"airspeed\": 14.2, \"speed\": 12.1, \"wind\": {\"speed\": 3.1, "
                + "\"from\": 250}, \"sd\": {\"position\": 2.4}}, "
                + "\"ground\": {\"role\": \"pilot\", \"tune_in_flight\": true}, "
                + "\"age_ms\": {\"orientation\": 12, \"rx\": 20, \"servo\": 20, \"flight\": 30, "
                + "\"location\": 300, \"altitude\": 30, \"heading\": 40, \"battery\": 4000, \"navigation\": 300}, "
                + "\"source\": {\"orientation\": \"arduino\", \"location\": \"android\", "
                + "\"altitude\": \"android\", \"heading\": \"arduino\"}, "
                + "\"system\": {\"clock_ms\": %d, \"uptime_s\": %d}}}",
                ++beacon, 18 + 3 * Math.sin(step / 7.0), 4 + 2 * Math.cos(step / 11.0), heading,
                latitude, longitude, 312 + altitude, distance, bearing, altitude, heading,
                latitude, longitude, System.nanoTime() / 1000000, step / 10);
    }
}
