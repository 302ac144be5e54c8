package org.raspilot.app;

import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertTrue;
import static org.robolectric.Shadows.shadowOf;

import android.content.Context;
import android.hardware.Sensor;
import android.os.PowerManager;
import android.view.View;
import android.widget.ListView;
import android.widget.RadioButton;
import java.io.File;
import java.io.IOException;
import java.util.Locale;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.junit.runner.RunWith;
import org.raspilot.up.commands.CommandForm;
import org.robolectric.RobolectricTestRunner;
import org.robolectric.RuntimeEnvironment;
import org.robolectric.annotation.Config;
import org.robolectric.annotation.GraphicsMode;

/**
 * Draws the screens by the system's own graphics library, with sensors, an aeroplane and real
 * sockets behind them. The property {@code pictures} is the folder; with {@code pictures.all} every
 * screen is drawn in every shape whose name contains its value, for a review of all of them.
 */
@RunWith(RobolectricTestRunner.class)
@Config(sdk = 29, qualifiers = PicturesTest.UPRIGHT)
@GraphicsMode(GraphicsMode.Mode.NATIVE)
public final class PicturesTest {
    static final String UPRIGHT = AppBench.UPRIGHT;
    private static final String LYING = AppBench.LYING;
    private static final String TABLET = AppBench.TABLET;
    private static final String TABLET_UPRIGHT = "sw800dp-w800dp-h1280dp-port-mdpi";
    private static final long MAX_BYTES = 150 * 1024;
    private static final int TRACK_FRAMES = 290;

    private final File folder = new File(System.getProperty("pictures"));
    private final TestPhone handset = new TestPhone();
    private PlayedProxy proxy;
    private PlayedBoard board;

    @Before
    public void begin() throws Exception {
        assertTrue(folder.isDirectory() || folder.mkdirs());
        proxy = new PlayedProxy();
        board = new PlayedBoard();
        handset.fitSensors();
        shadowOf((PowerManager) handset.application.getSystemService(Context.POWER_SERVICE))
                .setIgnoringBatteryOptimizations(handset.application.getPackageName(), true);
        handset.set(R.string.key_theme, "dark");
        handset.set(R.string.key_ground_host, "127.0.0.1");
        handset.set(R.string.key_ground_port, "" + proxy.port());
        handset.set(R.string.key_host, "127.0.0.1");
        handset.set(R.string.key_general_port, "" + board.port());
        handset.open();
        handset.window.get().findViewById(R.id.run_switch).performClick();
        assertTrue(handset.startWished());
        Wait.until("the Raspberry Pi hears", () -> !board.heard().isEmpty());
        handset.choose(Screen.GROUND);
        Wait.until("the proxy hears", () -> !proxy.heard().isEmpty());
        for (int frame = 0; frame < TRACK_FRAMES; frame++) {
            proxy.fly();
        }
        proxy.setFlying(true);
    }

    @After
    public void end() throws IOException {
        handset.close();
        proxy.close();
        board.close();
    }

    @Test
    public void thePicturesOfThePages() throws Exception {
        handset.choose(Screen.GROUND);
        // Its speed is known after some time of positions.
        for (int again = 0; again < 30; again++) {
            live();
        }
        documented("android-ground");
        handset.choose(Screen.AIRBORNE);
        for (int again = 0; again < 5; again++) {
            live();
        }
        documented("android-airborne");
        turn(UPRIGHT, "daylight");
        handset.choose(Screen.COMMANDS);
        open("arduino.pids.tunings");
        live();
        documented("android-commands");
        turn(TABLET, "daylight");
        handset.choose(Screen.GROUND);
        open("up.telemetry.frequency");
        live();
        documented("android-tablet");
        if (System.getProperty("pictures.all") != null) {
            all("phone-dark", UPRIGHT, "dark");
            all("wide-dark", LYING, "dark");
            all("tablet-dark", TABLET, "dark");
            all("tall-dark", TABLET_UPRIGHT, "dark");
            all("wide-day", LYING, "daylight");
            all("phone-day", UPRIGHT, "daylight");
            all("tablet-day", TABLET, "daylight");
            all("phone-german", "de-" + UPRIGHT, "daylight");
            all("tablet-german", "de-" + TABLET, "daylight");
        }
    }

    private void documented(String name) throws IOException {
        File file = draw(name);
        assertTrue(name + " has " + file.length() + " bytes", file.length() < MAX_BYTES);
    }

    private void turn(String qualifiers, String theme) {
        RuntimeEnvironment.setQualifiers(qualifiers);
        handset.set(R.string.key_theme, theme);
        handset.window.recreate();
    }

    private void all(String name, String qualifiers, String theme) throws Exception {
        if (!name.contains(System.getProperty("pictures.all"))) {
            return;
        }
        turn(qualifiers, theme);
        boolean isWide = handset.application.getResources().getBoolean(R.bool.two_panes);
        for (Screen screen : Screen.values()) {
            if (screen.hasTab(isWide)) {
                handset.choose(screen);
                live();
                draw(name + "-" + screen.name().toLowerCase(Locale.ROOT));
                if (screen == Screen.GROUND) {
                    panels(name);
                    stale(name);
                }
                if (screen == Screen.COMMANDS || isWide && screen == Screen.GROUND) {
                    pages(name);
                }
            }
        }
    }

    private void panels(String name) throws Exception {
        for (int id : new int[] {R.id.ground_show_state, R.id.ground_show_values,
            R.id.ground_show_track}) {
            RadioButton button = (RadioButton) handset.window.get().findViewById(id);
            if (button != null) {
                button.performClick();
                live();
                draw(name + "-ground-" + button.getText().toString().toLowerCase(Locale.ROOT));
            }
        }
    }

    private void stale(String name) throws Exception {
        proxy.setFlying(false);
        long beacon = handset.ground().snapshot().telemetry.beacon;
        Wait.until("silence", () -> handset.ground().snapshot().telemetry.age.isSilent(
                handset.ground().snapshot().nowMs)
                        && handset.ground().snapshot().telemetry.beacon >= beacon);
        Wait.pass(300);
        draw(name + "-stale");
        proxy.setFlying(true);
        live();
    }

    private void pages(String name) throws Exception {
        for (String command : new String[] {"up.arm", "arduino.pids.tunings",
            "up.telemetry.frequency", "up.flight_mode.set", "android.speak"}) {
            open(command);
            live();
            draw(name + "-commands-" + command);
            View back = handset.window.get().findViewById(R.id.commands_back);
            if (back != null) {
                back.performClick();
            }
        }
    }

    private void open(String command) {
        ListView list = (ListView) handset.window.get().findViewById(R.id.commands_list);
        for (int at = 0; at < list.getAdapter().getCount(); at++) {
            Object item = list.getAdapter().getItem(at);
            if (item instanceof CommandForm && ((CommandForm) item).name.equals(command)) {
                list.performItemClick(null, at, at);
                return;
            }
        }
        throw new AssertionError("the list has no " + command);
    }

    /** Makes the sensors deliver and the newest frame visible. */
    private void live() throws Exception {
        handset.sense(Sensor.TYPE_ROTATION_VECTOR, TestPhone.BANKED);
        handset.sense(Sensor.TYPE_GYROSCOPE, 0.01f, 0.02f, -0.01f);
        handset.sense(Sensor.TYPE_PRESSURE, 978.6f);
        handset.locate(49.74747, 13.37759, 345);
        assertNotNull(handset.ground());
        Long before = handset.ground().snapshot().telemetry.beacon;
        Wait.until("a new frame", () -> {
            Long now = handset.ground().snapshot().telemetry.beacon;
            return now != null && !now.equals(before);
        });
        Wait.pass(210);
    }

    private File draw(String name) throws IOException {
        return Drawing.of(handset.window.get()).save(new File(folder, name + ".png"));
    }
}
