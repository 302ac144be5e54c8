package org.raspilot.app;

import android.content.Context;
import android.content.res.TypedArray;
import android.graphics.PorterDuff;
import android.view.View;
import android.widget.Button;
import android.widget.TextView;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;

/** The upper part of the airborne screen: the link, start and stop, the configuration. */
final class RunPanel {
    private final Context context;
    private final TextView panic;
    private final TextView link;
    private final Button onOff;
    private final TextView mode;
    private final TextView where;
    private final TextView orientation;

    RunPanel(View root, View.OnClickListener pressed) {
        context = root.getContext();
        panic = (TextView) root.findViewById(R.id.run_panic);
        link = (TextView) root.findViewById(R.id.run_link);
        onOff = (Button) root.findViewById(R.id.run_switch);
        mode = (TextView) root.findViewById(R.id.run_mode);
        where = (TextView) root.findViewById(R.id.run_where);
        orientation = (TextView) root.findViewById(R.id.run_orientation);
        onOff.setOnClickListener(pressed);
    }

    void showSettings(AirborneSettings settings) {
        mode.setText(settings.mode == AirborneMode.BLACK_BOX
                ? R.string.mode_name_black_box : R.string.mode_name_flight_controller);
        where.setText(where(settings));
        orientation.setText(orientation(settings));
    }

    /** Shows that the configuration is invalid, and why. */
    void showFault(String sentence) {
        mode.setText(sentence);
        where.setText("");
        orientation.setText("");
    }

    /** Shows that nothing runs, and the newest line of the log, possibly with the reason. */
    void showStopped(boolean isSpawning, String newest) {
        panic.setVisibility(View.GONE);
        String state = context.getString(isSpawning ? R.string.link_spawning : R.string.link_off);
        TextViews.show(link, newest == null ? state : state + "\n" + newest);
        paint(isSpawning ? R.string.cancel : R.string.start,
                isSpawning ? R.attr.upAlarm : R.attr.upAccent,
                isSpawning ? R.attr.upOnAlarm : R.attr.upOnAccent);
    }

    /** Shows the running state; null: nothing is known of it yet. */
    void showRunning(AirborneStatus status) {
        boolean isPanic = status != null && status.panicDelayMs > 0;
        panic.setVisibility(isPanic ? View.VISIBLE : View.GONE);
        if (isPanic) {
            TextViews.show(panic, context.getString(R.string.panic, status.panicDelayMs));
        }
        TextViews.show(link, linkText(context, status));
        paint(R.string.stop_big, R.attr.upAlarm, R.attr.upOnAlarm);
    }

    /** Returns the state of the link; null: nothing is known of it yet. */
    static String linkText(Context context, AirborneStatus status) {
        if (status == null) {
            return context.getString(R.string.link_begins);
        }
        return status.isConnected ? context.getString(R.string.link_connected, status.endpoint.host,
                status.endpoint.generalPort) : status.linkText;
    }

    private String where(AirborneSettings settings) {
        if (settings.isByRunner()) {
            return context.getString(R.string.where_runner, settings.runnerHost,
                    settings.runnerPort, settings.aircraft, settings.runnerSecurityText());
        }
        if (settings.host.isEmpty()) {
            return context.getString(R.string.where_discovery, settings.discoveryPort);
        }
        return context.getString(R.string.where_host, settings.host, settings.generalPort,
                settings.orientationPort);
    }

    private String orientation(AirborneSettings settings) {
        OrientationTransport transport = settings.orientationTransport();
        if (transport != OrientationTransport.OFF) {
            return context.getString(R.string.orientation_on, transport.name(),
                    settings.orientationHz);
        }
        boolean isByMode = settings.orientation != OrientationTransport.OFF;
        return context.getString(isByMode ? R.string.orientation_off_mode
                : R.string.orientation_off);
    }

    private void paint(int text, int ground, int ink) {
        onOff.setText(text);
        onOff.setTextColor(colour(ink));
        onOff.getBackground().mutate().setColorFilter(colour(ground), PorterDuff.Mode.MULTIPLY);
    }

    private int colour(int attribute) {
        TypedArray found = context.obtainStyledAttributes(new int[] {attribute});
        try {
            return found.getColor(0, 0);
        } finally {
            found.recycle();
        }
    }
}
