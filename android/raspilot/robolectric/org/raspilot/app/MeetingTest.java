package org.raspilot.app;

import static org.junit.Assert.assertTrue;
import static org.junit.Assume.assumeNotNull;

import android.hardware.Sensor;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.ground.ControlStatus;
import org.robolectric.annotation.Config;

/**
 * Connects both ends of the application to a real daemon and a real proxy, started by the caller:
 * the properties {@code meeting.general}, {@code meeting.orientation}, {@code meeting.proxy} are
 * ports of 127.0.0.1, {@code meeting.aircraft} is the aircraft's name.
 */
@Config(sdk = 29)
public final class MeetingTest extends AppBench {
    private static final double LATITUDE = 49.74747;
    private static final int STEP_MS = 20;

    private static String property(String name) {
        return System.getProperty("meeting." + name);
    }

    @Before
    public void mustMeet() {
        assumeNotNull("No daemon to meet: tests/android/test_app.py starts them.",
                property("general"), property("proxy"));
        handset.fitSensors();
        handset.set(R.string.key_host, "127.0.0.1");
        handset.set(R.string.key_general_port, property("general"));
        handset.set(R.string.key_orientation_port, property("orientation"));
        handset.set(R.string.key_ground_host, "127.0.0.1");
        handset.set(R.string.key_ground_port, property("proxy"));
        handset.set(R.string.key_ground_aircraft, property("aircraft"));
    }

    private Double told(String path) {
        return handset.ground().snapshot().telemetry.number(path);
    }

    /** Runs the sensors and draws the screens until a condition holds. */
    private void fly(String what, Wait.Condition condition) throws Exception {
        Wait.until(what, () -> {
            step();
            return condition.holds();
        });
    }

    private void step() {
        handset.sense(Sensor.TYPE_PRESSURE, 978.6f);
        handset.sense(Sensor.TYPE_ROTATION_VECTOR, TestPhone.BANKED);
        handset.locate(LATITUDE, 13.37759, 345);
        Wait.pass(STEP_MS);
    }

    private void sendPeriod() throws Exception {
        if (find(R.id.page_send) == null) {
            openCommand("up.telemetry.frequency");
        }
        field().setText("50");
        fly("that it may be sent", () -> find(R.id.page_send).isEnabled());
        // A sent Command names the frame that was drawn.
        Drawing.of(handset.window.get());
        find(R.id.page_send).performClick();
    }

    private boolean isCarriedOut() {
        final String newest = text(R.id.commands_newest);
        return newest.startsWith("Telemetry period") && newest.contains("carried out");
    }

    @Test
    public void whatThePhoneInTheAirTellsIsSeenOnTheGroundThatCommands() throws Exception {
        handset.open();
        find(R.id.run_switch).performClick();
        assertTrue(handset.startWished());
        handset.choose(Screen.GROUND);
        fly("location and battery in telemetry", () -> told("location.latitude") != null
                && Math.abs(told("location.latitude") - LATITUDE) < 1e-9
                && told("android.batteryLevel") != null && told("android.batteryLevel") == 83);
        fly("the latitude on the screen", () -> {
            Drawing.of(handset.window.get());
            return text(R.id.ground_place).contains("49.74747");
        });
        fly("the seat", () -> handset.ground().snapshot().status != null
                && handset.ground().snapshot().status.control == ControlStatus.OURS);

        handset.choose(Screen.COMMANDS);
        // The app waits 3 s for an answer: of the test's time, which must not outrun a busy machine.
        for (int attempt = 0; attempt < 20 && !isCarriedOut(); attempt++) {
            sendPeriod();
            for (int step = 0; step < 200 && !isCarriedOut(); step++) {
                Thread.sleep(STEP_MS);
                step();
            }
        }
        assertTrue(text(R.id.commands_newest), isCarriedOut());
        // The rate is unknown until the frames of one second have been counted.
        fly("twenty frames a second", () -> handset.ground().snapshot().status.rateHz != null
                && handset.ground().snapshot().status.rateHz > 15);
    }
}
