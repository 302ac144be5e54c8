package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;
import static org.robolectric.Shadows.shadowOf;

import android.app.Notification;
import android.app.NotificationManager;
import android.app.Service;
import android.content.Context;
import android.content.Intent;
import android.hardware.Sensor;
import android.os.Build;
import android.os.PowerManager;
import java.io.IOException;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.android.BaseUpService;
import org.raspilot.up.providers.BatteryProvider;
import org.raspilot.up.providers.LocationProvider;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.providers.ProviderStatus;
import org.robolectric.annotation.Config;
import org.robolectric.shadows.ShadowPowerManager;
import org.robolectric.util.ReflectionHelpers;

/** The airborne service: in the foreground, awake, with and without sensors, restarted. */
public final class UpServiceTest extends AppBench {
    private PlayedBoard board;
    private AirborneStatus status;

    @Before
    public void listen() throws IOException {
        board = new PlayedBoard();
        handset.set(R.string.key_host, "127.0.0.1");
        handset.set(R.string.key_general_port, "" + board.port());
    }

    @After
    public void close() throws IOException {
        board.close();
    }

    private Intent wish() {
        return new Intent(handset.application, RaspilotUpService.class);
    }

    private void start() throws Exception {
        assertEquals(Service.START_STICKY, handset.deliver(wish(), 1));
        ((BaseUpService.Airside) handset.up.get().onBind(wish())).add(now -> status = now);
        Wait.until("the first status", () -> status != null);
    }

    private ProviderStatus provider(String name) {
        for (ProviderStatus each : status.providers) {
            if (each.name.equals(name)) {
                return each;
            }
        }
        throw new AssertionError("no provider " + name);
    }

    private static boolean isThreadAlive(String name) {
        for (Thread each : Thread.getAllStackTraces().keySet()) {
            if (each.getName().equals(name)) {
                return true;
            }
        }
        return false;
    }

    @Test
    public void itRunsInTheForegroundAndAwakeUntilItsNotificationStopsIt() throws Exception {
        start();
        Service service = handset.up.get();
        Notification shown = shadowOf(service).getLastForegroundNotification();
        assertNotNull(shown);
        assertTrue((shown.flags & Notification.FLAG_ONGOING_EVENT) != 0);
        if (Build.VERSION.SDK_INT >= 26) {
            NotificationManager manager = (NotificationManager) handset.application
                    .getSystemService(Context.NOTIFICATION_SERVICE);
            assertNotNull(manager.getNotificationChannel(shown.getChannelId()));
        }
        PowerManager.WakeLock lock = ShadowPowerManager.getLatestWakeLock();
        assertTrue(lock.isHeld());
        Wait.until("the Raspberry Pi", board::isConnected);
        Wait.until("its thread", () -> isThreadAlive("up"));
        // Public from Android 4.4 on only.
        Notification.Action[] actions = ReflectionHelpers.getField(shown, "actions");
        Intent stop = shadowOf(actions[0].actionIntent).getSavedIntent();
        assertEquals(Service.START_NOT_STICKY, handset.deliver(stop, 2));
        assertNull(handset.up);
        assertFalse(lock.isHeld());
        assertTrue(shadowOf(service).isForegroundStopped());
        Wait.until("the end of its threads",
                () -> !isThreadAlive("up") && !isThreadAlive("up sensors"));
    }

    @Test
    public void itComesBackWithTheSettingsOfNow() throws Exception {
        handset.set(R.string.key_general_port, "1");
        handset.set(R.string.key_general_port, "" + board.port());
        assertEquals(Service.START_STICKY, handset.deliver(null, 1));
        Wait.until("the Raspberry Pi", board::isConnected);
    }

    @Test
    public void settingsThatAreNoneStopItWithASentence() {
        handset.set(R.string.key_general_port, "many");
        assertEquals(Service.START_NOT_STICKY, handset.deliver(wish(), 1));
        assertNull(handset.up);
        mustSay("many", RaspilotApplication.of(handset.application).events().newest().text);
    }

    @Test
    public void aPhoneWithoutSensorsSaysWhatItLacks() throws Exception {
        start();
        assertEquals(4, status.providers.size());
        for (ProviderStatus each : status.providers) {
            if (!each.name.equals(BatteryProvider.NAME)) {
                assertEquals(each.name, ProviderState.ABSENT, each.state);
                assertFalse(each.sensor.isEmpty());
            }
        }
        handset.open();
        Wait.pass(0);
        mustSay(handset.application.getString(R.string.state_absent),
                text(R.id.provider_figures));
    }

    @Test
    public void whatTheSensorsTellIsSent() throws Exception {
        handset.fitSensors();
        start();
        Wait.until("location, altitude, heading and battery", () -> {
            handset.sense(Sensor.TYPE_ROTATION_VECTOR, TestPhone.BANKED);
            handset.sense(Sensor.TYPE_PRESSURE, 978.6f);
            handset.locate(49.74747, 13.37759, 345);
            return board.hasHeard("up.location.update") && board.hasHeard("up.altitude.change")
                    && board.hasHeard("up.heading.change") && board.hasHeard("android.battery");
        });
        String all = board.heard().toString();
        mustSay("49.74747", all);
        mustSay("\"satellites\": 9", all);
        mustSay("83", all);
        assertFalse(status.orientationHz() > 0);
        handset.battery(41);
        Wait.until("the current battery level", () -> board.heard().toString().contains("41"));
    }

    @Test
    @Config(sdk = 29)
    public void aPermissionThatIsGivenLaterIsUsedAtOnce() throws Exception {
        handset.fitSensors();
        shadowOf(handset.application).denyPermissions(
                android.Manifest.permission.ACCESS_FINE_LOCATION,
                android.Manifest.permission.ACCESS_COARSE_LOCATION);
        start();
        assertEquals(ProviderState.ABSENT, provider(LocationProvider.NAME).state);
        mustSay(handset.application.getString(R.string.lack_location_permission),
                provider(LocationProvider.NAME).sensor);
        handset.fitLocation();
        ((BaseUpService.Airside) handset.up.get().onBind(wish())).permissionsChanged();
        Wait.until("the location", () -> {
            handset.locate(49.74747, 13.37759, 345);
            return board.hasHeard("up.location.update");
        });
    }

    @Test
    @Config(sdk = 29)
    public void startAsksForThePermissionOnceAndGoesOnWithoutIt() {
        handset.open();
        shadowOf(handset.application).denyPermissions(
                android.Manifest.permission.ACCESS_FINE_LOCATION,
                android.Manifest.permission.ACCESS_COARSE_LOCATION);
        find(R.id.run_switch).performClick();
        assertNotNull(shadowOf(handset.window.get()).getLastRequestedPermission());
        assertFalse(handset.startWished());
        handset.window.get().onRequestPermissionsResult(1, new String[0], new int[0]);
        assertTrue(handset.startWished());
        Wait.pass(0);
        mustSay(handset.application.getString(R.string.stop_big), text(R.id.run_switch));
    }
}
