package org.raspilot.app;

import static org.robolectric.Shadows.shadowOf;

import android.app.Application;
import android.app.Service;
import android.content.ComponentName;
import android.content.Context;
import android.content.Intent;
import android.content.ServiceConnection;
import android.content.SharedPreferences;
import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorEventListener;
import android.hardware.SensorManager;
import android.location.Location;
import android.location.LocationManager;
import android.os.BatteryManager;
import android.os.Build;
import android.os.Bundle;
import android.os.IBinder;
import android.os.SystemClock;
import android.preference.PreferenceManager;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.android.TelemetryService;
import org.robolectric.Robolectric;
import org.robolectric.RuntimeEnvironment;
import org.robolectric.android.controller.ActivityController;
import org.robolectric.android.controller.ServiceController;
import org.robolectric.shadow.api.Shadow;
import org.robolectric.shadows.ShadowApplication;
import org.robolectric.shadows.ShadowInstrumentation;
import org.robolectric.shadows.ShadowSensor;
import org.robolectric.shadows.ShadowSensorManager;
import org.robolectric.util.ReflectionHelpers;

/** A phone with the application on it: what the system would do between its parts. */
final class TestPhone {
    /** Up, nose to the north, and 20 degrees of right bank, as a rotation vector. */
    static final float[] BANKED = {0, 0.17364818f, 0, 0.98480775f};

    final Application application = RuntimeEnvironment.getApplication();
    private final ShadowApplication shadow = shadowOf(application);
    private final ComponentName upName = new ComponentName(application, RaspilotUpService.class);
    private final ComponentName telemetryName =
            new ComponentName(application, RaspilotTelemetryService.class);
    private TelemetryService.Ground ground;
    ServiceController<RaspilotTelemetryService> telemetry;
    ServiceController<RaspilotUpService> up;
    ActivityController<MainActivity> window;

    TestPhone() {
        // The system connects no client to a service that does not run; the shadow would.
        shadow.declareComponentUnbindable(upName);
    }

    SharedPreferences preferences() {
        return PreferenceManager.getDefaultSharedPreferences(application);
    }

    /** Stores a setting as its screen does. */
    void set(int key, String value) {
        preferences().edit().putString(application.getString(key), value).commit();
    }

    void set(int key, boolean value) {
        preferences().edit().putBoolean(application.getString(key), value).commit();
    }

    /** Opens the window, with the service to which it binds. */
    MainActivity open() {
        telemetry = Robolectric.buildService(RaspilotTelemetryService.class).create();
        ground = (TelemetryService.Ground) telemetry.get().onBind(new Intent());
        shadow.setComponentNameAndServiceForBindServiceForIntent(
                new Intent(application, RaspilotTelemetryService.class), telemetryName,
                ground);
        window = Robolectric.buildActivity(MainActivity.class).setup();
        Wait.pass(0);
        return window.get();
    }

    /** Returns what the screens reach of the telemetry service. */
    TelemetryService.Ground ground() {
        return ground;
    }

    /** Chooses a screen by its tab. */
    void choose(Screen screen) {
        android.app.ActionBar bar = window.get().getActionBar();
        for (int at = 0; at < bar.getTabCount(); at++) {
            if (bar.getTabAt(at).getTag() == screen) {
                bar.setSelectedNavigationItem(at);
                window.get().getFragmentManager().executePendingTransactions();
                Wait.pass(0);
                return;
            }
        }
        throw new AssertionError("no tab for " + screen);
    }

    /** Does what the system does with the newest wish to start the airborne service. */
    boolean startWished() {
        Intent wish = shadow.getNextStartedService();
        if (wish == null || !upName.equals(wish.getComponent())) {
            return false;
        }
        deliver(wish, 1);
        return true;
    }

    /** Starts the airborne service by an intent, null as after its process was killed. */
    int deliver(Intent intent, int startId) {
        if (up == null) {
            up = Robolectric.buildService(RaspilotUpService.class, intent).create();
        }
        int answer = up.get().onStartCommand(intent, 0, startId);
        if (shadowOf((Service) up.get()).isStoppedBySelf()) {
            destroyUp();
        } else {
            bindUp(up.get().onBind(new Intent()));
        }
        Wait.pass(0);
        return answer;
    }

    /** Destroys the airborne service as the system does. */
    void destroyUp() {
        up.destroy();
        up = null;
        shadow.declareComponentUnbindable(upName);
        for (ServiceConnection each : waiting()) {
            each.onServiceDisconnected(upName);
        }
        Wait.pass(0);
    }

    /** Connects the clients that wait for the service, and later ones. */
    private void bindUp(IBinder binder) {
        unbindable().remove(upName);
        shadow.setComponentNameAndServiceForBindServiceForIntent(
                new Intent(application, RaspilotUpService.class), upName, binder);
        for (ServiceConnection each : waiting()) {
            each.onServiceConnected(upName, binder);
        }
    }

    private List<ComponentName> unbindable() {
        return ReflectionHelpers.getField(
                Shadow.extract(ShadowInstrumentation.getInstrumentation()),
                "unbindableComponents");
    }

    private List<ServiceConnection> waiting() {
        List<ServiceConnection> all = new ArrayList<>();
        for (ServiceConnection each : shadow.getBoundServiceConnections()) {
            if (each.getClass().getName().startsWith(AirborneLink.class.getName())) {
                all.add(each);
            }
        }
        return all;
    }

    void close() {
        if (window != null) {
            window.pause().stop().destroy();
        }
        if (up != null) {
            up.destroy();
        }
        if (telemetry != null) {
            telemetry.destroy();
        }
        Wait.pass(0);
    }

    /** Gives the phone every sensor that the application can use. */
    void fitSensors() {
        fit(Sensor.TYPE_ROTATION_VECTOR, "Rotation vector");
        fit(Sensor.TYPE_GYROSCOPE, "LSM6DS3 gyroscope");
        fit(Sensor.TYPE_PRESSURE, "LPS22 barometer");
        fitLocation();
        battery(83);
    }

    private void fit(int type, String name) {
        Sensor sensor = ShadowSensor.newInstance(type);
        ReflectionHelpers.setField(sensor, "mName", name);
        sensors().addSensor(sensor);
    }

    void fitLocation() {
        shadow.grantPermissions(android.Manifest.permission.ACCESS_FINE_LOCATION,
                android.Manifest.permission.ACCESS_COARSE_LOCATION);
        shadowOf(locations()).setProviderEnabled(LocationManager.GPS_PROVIDER, true);
    }

    void battery(int percent) {
        application.sendStickyBroadcast(new Intent(Intent.ACTION_BATTERY_CHANGED)
                .putExtra(BatteryManager.EXTRA_LEVEL, percent)
                .putExtra(BatteryManager.EXTRA_SCALE, 100)
                .putExtra(BatteryManager.EXTRA_TECHNOLOGY, "Li-ion"));
    }

    /** Delivers a sensor's values to all its listeners. */
    void sense(int type, float... values) {
        SensorEvent event = ShadowSensorManager.createSensorEvent(values.length, type);
        System.arraycopy(values, 0, event.values, 0, values.length);
        event.timestamp = SystemClock.elapsedRealtime() * 1000000L;
        // The shadow's own method would also notify listeners of other sensors.
        Sensor sensor = sensors().getSensorList(type).get(0);
        for (SensorEventListener each : sensors().getListeners()) {
            if (sensors().hasListener(each, sensor)) {
                each.onSensorChanged(event);
            }
        }
    }

    void locate(double latitudeDeg, double longitudeDeg, double altitudeM) {
        Location location = new Location(LocationManager.GPS_PROVIDER);
        location.setLatitude(latitudeDeg);
        location.setLongitude(longitudeDeg);
        location.setAltitude(altitudeM);
        location.setAccuracy(4);
        Bundle extras = new Bundle();
        extras.putInt("satellites", 9);
        location.setExtras(extras);
        location.setTime(System.currentTimeMillis());
        if (Build.VERSION.SDK_INT >= 17) {
            location.setElapsedRealtimeNanos(SystemClock.elapsedRealtime() * 1000000L + 1);
        }
        shadowOf(locations()).simulateLocation(location);
    }

    ShadowSensorManager sensors() {
        return shadowOf((SensorManager) application.getSystemService(Context.SENSOR_SERVICE));
    }

    private LocationManager locations() {
        return (LocationManager) application.getSystemService(Context.LOCATION_SERVICE);
    }
}
