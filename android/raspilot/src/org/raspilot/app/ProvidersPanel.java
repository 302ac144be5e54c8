package org.raspilot.app;

import android.content.Context;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.TextView;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.BatteryProvider;
import org.raspilot.up.providers.HeadingProvider;
import org.raspilot.up.providers.LocationProvider;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.providers.ProviderStatus;

/** The list of what the phone sends, and the counters. */
final class ProvidersPanel {
    private static final long LONG_MS = 10000;

    private final Context context;
    private final View idle;
    private final View zero;
    private final ViewGroup rows;
    private final View counted;
    private final TextView counters;

    ProvidersPanel(View root, View.OnClickListener zeroPressed) {
        context = root.getContext();
        idle = root.findViewById(R.id.providers_idle);
        zero = root.findViewById(R.id.providers_zero);
        rows = (ViewGroup) root.findViewById(R.id.providers_rows);
        counted = root.findViewById(R.id.providers_counted);
        counters = (TextView) root.findViewById(R.id.providers_counters);
        zero.setOnClickListener(zeroPressed);
    }

    /** Shows a status; null: nothing runs. */
    void show(AirborneStatus status) {
        List<ProviderStatus> providers = status == null
                ? Collections.emptyList() : status.providers;
        idle.setVisibility(providers.isEmpty() ? View.VISIBLE : View.GONE);
        while (rows.getChildCount() > providers.size()) {
            rows.removeViewAt(rows.getChildCount() - 1);
        }
        boolean isAltitudeRead = false;
        for (int at = 0; at < providers.size(); at++) {
            ProviderStatus provider = providers.get(at);
            show(row(at), provider);
            isAltitudeRead |= provider.name.equals(AltitudeProvider.NAME)
                    && provider.ageMs >= 0;
        }
        zero.setVisibility(isAltitudeRead ? View.VISIBLE : View.GONE);
        counted.setVisibility(status == null ? View.GONE : View.VISIBLE);
        counters.setText(status == null ? "" : counters(status));
    }

    private View row(int at) {
        if (at == rows.getChildCount()) {
            LayoutInflater.from(context).inflate(R.layout.row_provider, rows);
        }
        return rows.getChildAt(at);
    }

    private void show(View row, ProviderStatus provider) {
        boolean isAbsent = provider.state == ProviderState.ABSENT;
        set(row, R.id.provider_name, name(provider.name));
        set(row, R.id.provider_figures, isAbsent ? context.getString(R.string.state_absent)
                : context.getString(R.string.provider_figures,
                        context.getString(state(provider.state)), provider.rateHz,
                        age(provider.ageMs)));
        set(row, R.id.provider_value, provider.lastText);
        boolean isWrong = !provider.problem.isEmpty();
        set(row, R.id.provider_sensor, isWrong ? provider.problem : provider.sensor);
    }

    private String counters(AirborneStatus status) {
        String text = context.getString(R.string.counters, status.counters.telemetry,
                status.counters.executed,
                status.counters.refused, status.counters.malformed, status.counters.connections);
        return text + "\n" + context.getString(R.string.orientation_rate, status.orientationHz());
    }

    private String age(long ageMs) {
        if (ageMs < 0) {
            return context.getString(R.string.age_never);
        }
        return ageMs < LONG_MS ? context.getString(R.string.age_ms, ageMs)
                : context.getString(R.string.age_s, ageMs / 1000);
    }

    /** Returns the displayed name; an application's own provider has its plain name. */
    private String name(String provider) {
        switch (provider) {
            case LocationProvider.NAME:
                return context.getString(R.string.provider_location);
            case AltitudeProvider.NAME:
                return context.getString(R.string.provider_altitude);
            case HeadingProvider.NAME:
                return context.getString(R.string.provider_heading);
            case BatteryProvider.NAME:
                return context.getString(R.string.provider_battery);
            case OrientationProvider.NAME:
                return context.getString(R.string.provider_orientation);
            default:
                return provider;
        }
    }

    private static int state(ProviderState state) {
        switch (state) {
            case ABSENT:
                return R.string.state_absent;
            case STOPPED:
                return R.string.state_stopped;
            case WAITING:
                return R.string.state_waiting;
            case SENDING:
                return R.string.state_sending;
            default:
                return R.string.state_silent;
        }
    }

    private static void set(View row, int id, String text) {
        TextView view = (TextView) row.findViewById(id);
        view.setVisibility(text.isEmpty() ? View.GONE : View.VISIBLE);
        view.setText(text);
    }
}
