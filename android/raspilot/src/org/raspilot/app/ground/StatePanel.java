package org.raspilot.app.ground;

import android.content.Context;
import android.content.Intent;
import android.content.IntentFilter;
import android.content.res.Resources;
import android.os.BatteryManager;
import android.text.TextUtils;
import android.view.View;
import android.view.ViewGroup;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Alarms;
import org.raspilot.up.ground.FlightModes;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.TelemetrySchema;
import org.raspilot.up.ground.TelemetryText;

/** Control, mode, vetoes, and the state of board, phones and load. */
final class StatePanel {
    private static final double LOW_PERCENT = Alarms.limit("battery_low");
    private static final long BATTERY_EACH_MS = 5000;

    private final Context context;
    private final Resources words;
    private final Row mode;
    private final Row fallback;
    private final Row armed;
    private final Row vetoes;
    private final Row raspilot;
    private final Row switchRow;
    private final Row failsafe;
    private final Row receiver;
    private final Row imu;
    private final Row board;
    private final Row panic;
    private final Row load;
    private final Row stale;
    private final Row home;
    private final Row flightBattery;
    private final Row aircraftBattery;
    private final Row phoneBattery;
    private final Row blackBox;
    private final Map<String, Row> navigation = new LinkedHashMap<>();
    private String phonePercent = "";
    private boolean isPhoneLow;
    private long batteryLookedMs;

    StatePanel(View root) {
        context = root.getContext().getApplicationContext();
        words = root.getResources();
        ViewGroup list = (ViewGroup) root.findViewById(R.id.ground_state);
        InstrumentColors colors = InstrumentColors.of(root.getContext());
        mode = Row.in(list, R.string.state_mode, colors);
        fallback = Row.in(list, R.string.state_fallback, colors);
        armed = Row.in(list, R.string.state_motor, colors);
        vetoes = Row.in(list, R.string.state_vetoes, colors);
        failsafe = Row.in(list, R.string.state_failsafe, colors);
        panic = Row.in(list, R.string.state_panic, colors);
        stale = Row.in(list, R.string.state_stale, colors);
        switchRow = Row.in(list, R.string.state_switch, colors);
        raspilot = Row.in(list, R.string.state_raspilot, colors);
        receiver = Row.in(list, R.string.state_receiver, colors);
        imu = Row.in(list, R.string.state_imu, colors);
        board = Row.in(list, R.string.state_board, colors);
        home = Row.in(list, R.string.state_home, colors);
        flightBattery = Row.in(list, R.string.state_flight_battery, colors);
        aircraftBattery = Row.in(list, R.string.state_aircraft_battery, colors);
        phoneBattery = Row.in(list, R.string.state_phone_battery, colors);
        load = Row.in(list, R.string.state_load, colors);
        blackBox = Row.in(list, R.string.state_black_box, colors);
        for (Map.Entry<String, String> each : TelemetrySchema.navigation().entrySet()) {
            Row row = Row.in(list, R.string.state_home, colors);
            row.label(each.getKey());
            navigation.put(each.getValue(), row);
        }
    }

    void update(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        String flown = FlightModes.actingWithProgress(telemetry);
        show(mode, picture, "flight_mode", flown, Row.Look.PLAIN);
        String replaced = FlightModes.fallback(telemetry);
        fallback.setVisible(replaced != null);
        show(fallback, picture, "flight_control.fallback", replaced, Row.Look.ALARM);
        text(raspilot, picture, "mode");
        text(switchRow, picture, "arduino.switch");
        Boolean isArmed = telemetry.flag("armed");
        flag(armed, picture, "armed", R.string.armed_yes, R.string.armed_no, Row.Look.WARNING,
                Row.Look.PLAIN);
        showVetoes(picture, isArmed);
        String cause = FlightModes.failsafe(telemetry);
        if (cause != null) {
            show(failsafe, picture, "failsafe.cause", cause, Row.Look.ALARM);
        } else {
            flag(failsafe, picture, "arduino.failsafe", R.string.state_acts, R.string.state_no,
                    Row.Look.ALARM, Row.Look.PLAIN);
        }
        flag(receiver, picture, "arduino.receiver_valid", R.string.state_valid,
                R.string.state_invalid, Row.Look.PLAIN, Row.Look.ALARM);
        flag(imu, picture, "arduino.imu_valid", R.string.state_valid, R.string.state_invalid,
                Row.Look.PLAIN, Row.Look.ALARM);
        flag(board, picture, "arduino.connected", R.string.state_connected, R.string.state_gone,
                Row.Look.PLAIN, Row.Look.ALARM);
        showPanic(picture);
        showLoad(picture);
        showHome(picture);
        showStale(picture);
        showBatteries(picture);
        showBlackBox(picture);
        showNavigation(picture);
    }

    /** Shows what the aircraft estimates of its flight; without an estimate there are no rows. */
    private void showNavigation(GroundSnapshot picture) {
        boolean isThere = picture.telemetry.number("navigation.latitude") != null;
        for (Map.Entry<String, Row> each : navigation.entrySet()) {
            String path = each.getKey();
            String text = TelemetryText.value(picture.telemetry, path);
            boolean isShown = text != null || !TelemetrySchema.isOptional(path);
            each.getValue().setVisible(isThere && isShown);
            show(each.getValue(), picture, path, text, Row.Look.PLAIN);
        }
    }

    private void showVetoes(GroundSnapshot picture, Boolean isArmed) {
        List<String> all = picture.telemetry.texts("vetoes");
        boolean isFree = all != null && all.isEmpty();
        String text = all == null ? "" : isFree ? words.getString(R.string.state_none)
                : TextUtils.join("; ", all);
        // In the air a veto is not a warning: it only states what blocks arming again.
        boolean isWarning = !isFree && !Boolean.TRUE.equals(isArmed);
        show(vetoes, picture, "vetoes", all == null ? null : text,
                isWarning ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private void showPanic(GroundSnapshot picture) {
        Boolean isPanic = picture.telemetry.flag("load.panic");
        String text = null;
        if (isPanic != null) {
            text = isPanic
                    ? TelemetryText.busy(picture.telemetry) : words.getString(R.string.state_no);
        }
        show(panic, picture, "load.panic", text, Row.Look.PLAIN);
    }

    private void showLoad(GroundSnapshot picture) {
        Double cpu = picture.telemetry.number("load.cpu");
        Double ram = picture.telemetry.number("load.ram");
        String text = cpu == null || ram == null ? null
                : words.getString(R.string.state_load_value, Math.round(cpu), Math.round(ram));
        show(load, picture, "load.cpu", text, Row.Look.PLAIN);
    }

    private void showHome(GroundSnapshot picture) {
        Double distance = picture.telemetry.number("home.distance");
        Double bearing = picture.telemetry.number("home.bearing");
        String text = distance == null || bearing == null ? null
                : words.getString(R.string.state_home_value, Math.round(distance),
                        Math.round(bearing));
        show(home, picture, "home.distance", text, Row.Look.PLAIN);
    }

    private void showStale(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        if (telemetry.isSilent(picture.nowMs)) {
            boolean wasThere = telemetry.ageMs(picture.nowMs) != null;
            String text = words.getString(wasThere ? R.string.state_all : R.string.state_nothing);
            stale.show(text, Freshness.LIVE, "", Row.Look.ALARM);
            return;
        }
        StringBuilder all = new StringBuilder();
        for (String reading : Age.readings()) {
            if (telemetry.readingAgeMs(reading, picture.nowMs) != null
                    && telemetry.age.isStale(reading, picture.nowMs)) {
                all.append(all.length() == 0 ? "" : ", ").append(reading);
            }
        }
        boolean isFresh = all.length() == 0;
        stale.show(isFresh ? words.getString(R.string.state_none) : all.toString(),
                Freshness.LIVE, "", isFresh ? Row.Look.PLAIN : Row.Look.WARNING);
    }

    private void showBatteries(GroundSnapshot picture) {
        String voltage = TelemetryText.value(picture.telemetry, "arduino.flight_battery_v");
        boolean isCritical = isTrue(picture, "arduino.flight_battery_critical");
        boolean isLow = isTrue(picture, "arduino.flight_battery_low");
        show(flightBattery, picture, "arduino.flight_battery_v", voltage,
                isCritical ? Row.Look.ALARM : isLow ? Row.Look.WARNING : Row.Look.PLAIN);
        Double percent = picture.telemetry.number("android.batteryLevel");
        String text = percent == null ? null : percent(percent);
        show(aircraftBattery, picture, "android.batteryLevel", text,
                percent != null && percent < LOW_PERCENT ? Row.Look.WARNING : Row.Look.PLAIN);
        long nowMs = android.os.SystemClock.elapsedRealtime();
        if (phonePercent.isEmpty() || nowMs - batteryLookedMs > BATTERY_EACH_MS) {
            batteryLookedMs = nowMs;
            readBattery();
        }
        phoneBattery.show(phonePercent,
                phonePercent.isEmpty() ? Freshness.NONE : Freshness.LIVE, "",
                isPhoneLow ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private void readBattery() {
        Intent told = context.registerReceiver(null,
                new IntentFilter(Intent.ACTION_BATTERY_CHANGED));
        int level = told == null ? -1 : told.getIntExtra(BatteryManager.EXTRA_LEVEL, -1);
        int scale = told == null ? 0 : told.getIntExtra(BatteryManager.EXTRA_SCALE, 0);
        boolean isKnown = level >= 0 && scale > 0;
        double percent = isKnown ? 100.0 * level / scale : 0;
        phonePercent = isKnown ? percent(percent) : "";
        isPhoneLow = isKnown && percent < LOW_PERCENT;
    }

    private void showBlackBox(GroundSnapshot picture) {
        String problem = picture.telemetry.text("black_box.problem");
        Boolean isRecording = picture.telemetry.flag("black_box.recording");
        blackBox.setVisible(isRecording != null);
        if (isRecording == null) {
            return;
        }
        String text = problem != null ? problem
                : words.getString(isRecording ? R.string.state_records : R.string.state_no);
        show(blackBox, picture, "black_box.recording", text,
                problem != null ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private static boolean isTrue(GroundSnapshot picture, String path) {
        return Boolean.TRUE.equals(picture.telemetry.flag(path));
    }

    private void text(Row row, GroundSnapshot picture, String path) {
        show(row, picture, path, picture.telemetry.text(path), Row.Look.PLAIN);
    }

    private void flag(Row row, GroundSnapshot picture, String path, int yes, int no,
            Row.Look lookOfYes,
            Row.Look lookOfNo) {
        Boolean flag = picture.telemetry.flag(path);
        String text = flag == null ? null : words.getString(flag ? yes : no);
        show(row, picture, path, text, Boolean.TRUE.equals(flag) ? lookOfYes : lookOfNo);
    }

    private static void show(Row row, GroundSnapshot picture, String path, String text,
            Row.Look look) {
        Freshness freshness = text == null ? Freshness.NONE
                : picture.telemetry.freshness(path, picture.nowMs);
        row.show(text == null ? "" : text, freshness,
                InstrumentPanel.ageText(picture, path), look);
    }

    private static String percent(double percent) {
        return String.format(Locale.ROOT, "%d %%", Math.round(percent));
    }
}
