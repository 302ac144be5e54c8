package org.raspilot.app.ground;

import android.view.View;
import org.raspilot.app.R;
import org.raspilot.app.view.AttitudeView;
import org.raspilot.app.view.BarsView;
import org.raspilot.app.view.CompassView;
import org.raspilot.app.view.Instrument;
import org.raspilot.app.view.TapeView;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.Telemetry;

/** Horizon, speed, altitude, compass, sticks and servos. */
final class InstrumentPanel {
    private static final String[] CHANNELS = {
        "ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"
    };
    private static final int SERVOS = 4;

    private final AttitudeView attitude;
    private final TapeView speed;
    private final TapeView altitude;
    private final CompassView compass;
    private final BarsView sticks;
    private final BarsView servos;
    private final GroundSpeed groundSpeed;

    /** Finds its views; the caller owns the history of the speed. */
    InstrumentPanel(View root, GroundSpeed groundSpeed) {
        this.groundSpeed = groundSpeed;
        attitude = (AttitudeView) root.findViewById(R.id.ground_attitude);
        speed = (TapeView) root.findViewById(R.id.ground_speed);
        altitude = (TapeView) root.findViewById(R.id.ground_altitude);
        compass = (CompassView) root.findViewById(R.id.ground_compass);
        sticks = (BarsView) root.findViewById(R.id.ground_sticks);
        servos = (BarsView) root.findViewById(R.id.ground_servos);
        sticks.setTitle(root.getResources().getString(R.string.ground_sticks), CHANNELS.length);
        servos.setTitle(root.getResources().getString(R.string.ground_servos), SERVOS);
    }

    void update(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        Double roll = telemetry.number("orientation.roll");
        Double pitch = telemetry.number("orientation.pitch");
        boolean isThere = roll != null && pitch != null;
        if (isThere) {
            attitude.setAttitude(roll, pitch);
        }
        age(attitude, picture, "orientation.roll", isThere);
        showSpeed(picture);
        Double metres = telemetry.number("altitude");
        if (metres != null) {
            altitude.setValue(metres);
        }
        age(altitude, picture, "altitude", metres != null);
        Double heading = telemetry.number("heading.actual");
        if (heading != null) {
            compass.setHeading(heading, telemetry.number("home.bearing"));
        }
        age(compass, picture, "heading.actual", heading != null);
        showBars(sticks, picture, "rx", CHANNELS.length);
        showBars(servos, picture, "servo", SERVOS);
    }

    private void showSpeed(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        Double latitude = telemetry.number("location.latitude");
        Double longitude = telemetry.number("location.longitude");
        Long ageMs = telemetry.age.readingMs("location", picture.nowMs);
        if (latitude != null && longitude != null && ageMs != null) {
            groundSpeed.update(latitude, longitude, picture.nowMs - ageMs);
        }
        Double now = groundSpeed.metresPerSecond();
        if (now != null) {
            speed.setValue(now);
        }
        age(speed, picture, "location.latitude", now != null);
    }

    private void showBars(BarsView bars, GroundSnapshot picture, String part, int count) {
        boolean isThere = false;
        for (int channel = 0; channel < count; channel++) {
            Double pulse = picture.telemetry.number(part + "." + CHANNELS[channel]);
            bars.setChannel(channel, pulse);
            isThere |= pulse != null;
        }
        age(bars, picture, part, isThere);
    }

    private static void age(Instrument instrument, GroundSnapshot picture, String path,
            boolean isThere) {
        Freshness freshness = isThere ? picture.telemetry.freshness(path, picture.nowMs)
                : Freshness.NONE;
        instrument.setFreshness(freshness, ageText(picture, path));
    }

    /** Returns the age of the value at a path: the reading's age, otherwise its frame's. */
    static String ageText(GroundSnapshot picture, String path) {
        Telemetry telemetry = picture.telemetry;
        Long ageMs = telemetry.age.readingMs(Telemetry.readingOf(path), picture.nowMs);
        return Age.text(ageMs == null ? telemetry.age.frameMs(picture.nowMs) : ageMs);
    }
}
