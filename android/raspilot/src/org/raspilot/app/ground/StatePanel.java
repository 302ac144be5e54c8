package org.raspilot.app.ground;

import android.content.Context;
import android.content.res.Resources;
import android.text.TextUtils;
import android.util.SparseArray;
import android.view.View;
import android.view.ViewGroup;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.up.android.BatterySource;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Alarms;
import org.raspilot.up.ground.FlightModes;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.TelemetrySchema;
import org.raspilot.up.ground.TelemetryText;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;

/** Control, mode, vetoes, and the state of board, phones and load. */
final class StatePanel {
    private static final double LOW_PERCENT = Alarms.limit("battery_low");
    private static final long BATTERY_EACH_MS = 5000;
    /** The rows that are always there, in their order. */
    private static final int[] LABELS = {
        R.string.state_mode, R.string.state_fallback, R.string.state_motor, R.string.state_vetoes,
        R.string.state_failsafe, R.string.state_panic, R.string.state_stale,
        R.string.state_switch, R.string.state_raspilot, R.string.state_receiver,
        R.string.state_imu, R.string.state_board, R.string.state_home,
        R.string.state_flight_battery, R.string.state_aircraft_battery,
        R.string.state_phone_battery, R.string.state_load, R.string.state_black_box
    };

    private final Context context;
    private final Resources words;
    private final SparseArray<Row> rows = new SparseArray<>();
    private final Map<String, Row> navigation = new LinkedHashMap<>();
    private String phonePercent = "";
    private boolean isPhoneLow;
    private long batteryLookedMs;

    StatePanel(View root) {
        context = root.getContext().getApplicationContext();
        words = root.getResources();
        ViewGroup list = (ViewGroup) root.findViewById(R.id.ground_state);
        InstrumentColors colors = InstrumentColors.of(root.getContext());
        for (int label : LABELS) {
            rows.put(label, Row.in(list, label, colors));
        }
        for (Map.Entry<String, String> each : TelemetrySchema.navigation().entrySet()) {
            Row row = Row.in(list, R.string.state_home, colors);
            row.label(each.getKey());
            navigation.put(each.getValue(), row);
        }
    }

    void update(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        String flown = FlightModes.actingWithProgress(telemetry);
        show(row(R.string.state_mode), picture, "flight_mode", flown, Row.Look.PLAIN);
        String replaced = FlightModes.fallback(telemetry);
        row(R.string.state_fallback).setVisible(replaced != null);
        show(row(R.string.state_fallback), picture, "flight_control.fallback", replaced,
                Row.Look.ALARM);
        text(row(R.string.state_raspilot), picture, "mode");
        text(row(R.string.state_switch), picture, "arduino.switch");
        Boolean isArmed = telemetry.flag("armed");
        flag(row(R.string.state_motor), picture, "armed", R.string.armed_yes, R.string.armed_no,
                Row.Look.WARNING, Row.Look.PLAIN);
        showVetoes(picture, isArmed);
        String cause = FlightModes.failsafe(telemetry);
        if (cause != null) {
            show(row(R.string.state_failsafe), picture, "failsafe.cause", cause, Row.Look.ALARM);
        } else {
            flag(row(R.string.state_failsafe), picture, "arduino.failsafe", R.string.state_acts,
                    R.string.state_no, Row.Look.ALARM, Row.Look.PLAIN);
        }
        flag(row(R.string.state_receiver), picture, "arduino.receiver_valid", R.string.state_valid,
                R.string.state_invalid, Row.Look.PLAIN, Row.Look.ALARM);
        flag(row(R.string.state_imu), picture, "arduino.imu_valid", R.string.state_valid,
                R.string.state_invalid, Row.Look.PLAIN, Row.Look.ALARM);
        flag(row(R.string.state_board), picture, "arduino.connected", R.string.state_connected,
                R.string.state_gone, Row.Look.PLAIN, Row.Look.ALARM);
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
        show(row(R.string.state_vetoes), picture, "vetoes", all == null ? null : text,
                isWarning ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private void showPanic(GroundSnapshot picture) {
        Boolean isPanic = picture.telemetry.flag("load.panic");
        String text = null;
        if (isPanic != null) {
            text = isPanic
                    ? TelemetryText.busy(picture.telemetry) : words.getString(R.string.state_no);
        }
        show(row(R.string.state_panic), picture, "load.panic", text, Row.Look.PLAIN);
    }

    private void showLoad(GroundSnapshot picture) {
        Double cpu = picture.telemetry.number("load.cpu");
        Double ram = picture.telemetry.number("load.ram");
        String text = cpu == null || ram == null ? null
                : words.getString(R.string.state_load_value, Math.round(cpu), Math.round(ram));
        show(row(R.string.state_load), picture, "load.cpu", text, Row.Look.PLAIN);
    }

    private void showHome(GroundSnapshot picture) {
        Double distance = picture.telemetry.number("home.distance");
        Double bearing = picture.telemetry.number("home.bearing");
        String text = distance == null || bearing == null ? null
                : words.getString(R.string.state_home_value, Math.round(distance),
                        Math.round(bearing));
        show(row(R.string.state_home), picture, "home.distance", text, Row.Look.PLAIN);
    }

    private void showStale(GroundSnapshot picture) {
        Telemetry telemetry = picture.telemetry;
        if (telemetry.age.isSilent(picture.nowMs)) {
            boolean wasThere = telemetry.age.frameMs(picture.nowMs) != null;
            String text = words.getString(wasThere ? R.string.state_all : R.string.state_nothing);
            row(R.string.state_stale).show(text, Freshness.LIVE, "", Row.Look.ALARM);
            return;
        }
        StringBuilder all = new StringBuilder();
        for (String reading : Age.readings()) {
            if (telemetry.age.readingMs(reading, picture.nowMs) != null
                    && telemetry.age.isStale(reading, picture.nowMs)) {
                all.append(all.length() == 0 ? "" : ", ").append(reading);
            }
        }
        boolean isFresh = all.length() == 0;
        String text = isFresh ? words.getString(R.string.state_none) : all.toString();
        row(R.string.state_stale).show(text, Freshness.LIVE, "",
                isFresh ? Row.Look.PLAIN : Row.Look.WARNING);
    }

    private void showBatteries(GroundSnapshot picture) {
        String voltage = TelemetryText.value(picture.telemetry, "arduino.flight_battery_v");
        boolean isCritical = isTrue(picture, "arduino.flight_battery_critical");
        boolean isLow = isTrue(picture, "arduino.flight_battery_low");
        show(row(R.string.state_flight_battery), picture, "arduino.flight_battery_v", voltage,
                isCritical ? Row.Look.ALARM : isLow ? Row.Look.WARNING : Row.Look.PLAIN);
        Double percent = picture.telemetry.number("android.batteryLevel");
        String text = percent == null ? null : percent(percent);
        show(row(R.string.state_aircraft_battery), picture, "android.batteryLevel", text,
                percent != null && percent < LOW_PERCENT ? Row.Look.WARNING : Row.Look.PLAIN);
        long nowMs = android.os.SystemClock.elapsedRealtime();
        if (phonePercent.isEmpty() || nowMs - batteryLookedMs > BATTERY_EACH_MS) {
            batteryLookedMs = nowMs;
            readBattery();
        }
        row(R.string.state_phone_battery).show(phonePercent,
                phonePercent.isEmpty() ? Freshness.NONE : Freshness.LIVE, "",
                isPhoneLow ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private void readBattery() {
        BatteryLevel level = BatterySource.level(context);
        phonePercent = level == null ? "" : percent(level.percent);
        isPhoneLow = level != null && level.percent < LOW_PERCENT;
    }

    private void showBlackBox(GroundSnapshot picture) {
        String problem = picture.telemetry.text("black_box.problem");
        Boolean isRecording = picture.telemetry.flag("black_box.recording");
        row(R.string.state_black_box).setVisible(isRecording != null);
        if (isRecording == null) {
            return;
        }
        String text = problem != null ? problem
                : words.getString(isRecording ? R.string.state_records : R.string.state_no);
        show(row(R.string.state_black_box), picture, "black_box.recording", text,
                problem != null ? Row.Look.WARNING : Row.Look.PLAIN);
    }

    private Row row(int label) {
        return rows.get(label);
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
