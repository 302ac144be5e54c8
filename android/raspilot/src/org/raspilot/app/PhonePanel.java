package org.raspilot.app;

import android.Manifest;
import android.app.Activity;
import android.content.ActivityNotFoundException;
import android.content.Intent;
import android.net.Uri;
import android.os.Build;
import android.provider.Settings;
import android.view.View;
import android.widget.CheckBox;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.android.Permissions;
import org.raspilot.up.android.api23.Api23;

/** The phone's settings that the app needs, links to them, and whether the screen stays on. */
final class PhonePanel {
    private static final int REQUEST = 1;
    /** Android 6; the API 16 stubs do not know it. */
    private static final String BATTERY_SCREEN =
            "android.settings.IGNORE_BATTERY_OPTIMIZATION_SETTINGS";
    private static final int TIRAMISU = 33;

    private final Activity activity;
    private final View location;
    private final View battery;
    private boolean isPermitting;

    PhonePanel(Activity activity, final View root, final AppSettings settings) {
        this.activity = activity;
        location = root.findViewById(R.id.phone_location);
        battery = root.findViewById(R.id.phone_battery);
        root.findViewById(R.id.phone_location_permit).setOnClickListener(
                pressed -> permit());
        root.findViewById(R.id.phone_battery_settings).setOnClickListener(
                pressed -> open(new Intent(BATTERY_SCREEN)));
        CheckBox keep = (CheckBox) root.findViewById(R.id.phone_keep_screen);
        keep.setChecked(settings.isScreenKept());
        root.setKeepScreenOn(settings.isScreenKept());
        keep.setOnCheckedChangeListener((box, isChecked) -> {
            settings.setScreenKept(isChecked);
            root.setKeepScreenOn(isChecked);
        });
    }

    void show() {
        location.setVisibility(isLocationPermitted() ? View.GONE : View.VISIBLE);
        boolean isSpared = Build.VERSION.SDK_INT < 23 || Api23.isSpared(activity);
        battery.setVisibility(isSpared ? View.GONE : View.VISIBLE);
    }

    /** Returns whether the location may be read with the precision that an aeroplane needs. */
    boolean isLocationPermitted() {
        return Permissions.has(activity, Manifest.permission.ACCESS_FINE_LOCATION);
    }

    /** Requests the missing permissions from the user; returns false if none is missing. */
    boolean requestPermissions() {
        List<String> missing = missing();
        if (Build.VERSION.SDK_INT < 23 || missing.isEmpty()) {
            return false;
        }
        Api23.requestPermissions(activity, missing.toArray(new String[0]), REQUEST);
        return true;
    }

    private List<String> missing() {
        List<String> missing = new ArrayList<>();
        if (!isLocationPermitted()) {
            missing.add(Manifest.permission.ACCESS_FINE_LOCATION);
            missing.add(Manifest.permission.ACCESS_COARSE_LOCATION);
        }
        // For applications of an older target the system asks automatically.
        boolean isOurs = Build.VERSION.SDK_INT >= TIRAMISU
                && activity.getApplicationInfo().targetSdkVersion >= TIRAMISU;
        if (isOurs && !Permissions.has(activity, Permissions.POST_NOTIFICATIONS)) {
            missing.add(Permissions.POST_NOTIFICATIONS);
        }
        return missing;
    }

    /** Called when the user, or the system without a dialog, has answered. */
    void onAnswered() {
        show();
        boolean isRefusedForGood = Build.VERSION.SDK_INT >= 23 && !isLocationPermitted()
                && !Api23.isReasonDue(activity,
                        Manifest.permission.ACCESS_FINE_LOCATION);
        if (isPermitting && isRefusedForGood) {
            open(new Intent(Settings.ACTION_APPLICATION_DETAILS_SETTINGS,
                    Uri.fromParts("package", activity.getPackageName(), null)));
        }
        isPermitting = false;
    }

    /** Requests them; if the system shows no dialog, opens its page of permissions. */
    private void permit() {
        isPermitting = requestPermissions();
    }

    private void open(Intent screen) {
        try {
            activity.startActivity(screen);
        } catch (ActivityNotFoundException missing) {
            RaspilotApplication.of(activity).log(activity.getString(R.string.not_openable));
        }
    }
}
