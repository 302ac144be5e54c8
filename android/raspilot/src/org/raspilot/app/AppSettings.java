package org.raspilot.app;

import android.content.Context;
import android.content.SharedPreferences;
import android.preference.PreferenceManager;
import java.util.Locale;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.android.PairingStore;
import org.raspilot.up.ground.GroundSettings;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.Side;
import org.raspilot.up.tls.TlsIdentity;
import org.raspilot.up.wire.ProxyRole;

/**
 * The user's settings. An invalid value (of an older version, of a broken file) throws an
 * IllegalArgumentException with a sentence when it is used.
 */
final class AppSettings {
    private final Context context;
    private final SharedPreferences preferences;

    AppSettings(Context context) {
        this.context = context.getApplicationContext();
        preferences = PreferenceManager.getDefaultSharedPreferences(this.context);
    }

    AirborneSettings airborne() {
        String runner = text(R.string.key_runner_host, R.string.default_runner_host);
        String aircraft = text(R.string.key_aircraft, R.string.default_aircraft);
        boolean isByRunner = mode() == AirborneMode.BLACK_BOX && !runner.isEmpty();
        return new AirborneSettings.Builder()
                .mode(mode())
                .host(text(R.string.key_host, R.string.default_host))
                .generalPort(port(R.string.key_general_port, R.string.default_general_port))
                .orientationPort(port(R.string.key_orientation_port,
                        R.string.default_orientation_port))
                .discoveryPort(port(R.string.key_discovery_port, R.string.default_discovery_port))
                .runnerHost(runner)
                .runnerTls(isByRunner ? tls(R.string.key_runner_tls) : null)
                .pairing(isByRunner ? new PairingStore(context).get(aircraft) : null)
                .runnerPort(port(R.string.key_runner_port, R.string.default_runner_port))
                .aircraft(aircraft)
                .profile(text(R.string.key_profile, R.string.default_profile))
                .orientation(transport())
                .redundantOrientation(preferences.getBoolean(
                        context.getString(R.string.key_redundant_orientation), false))
                .orientationHz(whole(R.string.key_orientation_hz, R.string.default_orientation_hz,
                        SettingRule.RATE))
                .referencePressureHPa(referencePressureHPa())
                .mounting(mounting())
                .build();
    }

    /** Returns all of the ground side, with this phone's key of the aircraft. */
    GroundSettings ground() {
        boolean isListening = preferences.getBoolean(
                context.getString(R.string.key_ground_listen), false);
        boolean isDirect = preferences.getBoolean(
                context.getString(R.string.key_ground_direct), false);
        String aircraft = text(R.string.key_ground_aircraft, R.string.default_ground_aircraft);
        return new GroundSettings(
                text(R.string.key_ground_host, R.string.default_ground_host),
                port(R.string.key_ground_port, R.string.default_ground_port), aircraft,
                isListening ? ProxyRole.LISTEN : ProxyRole.COMMAND, isDirect)
                .withPairing(new PairingStore(context).get(aircraft))
                .withTls(tls(R.string.key_ground_tls));
    }

    /** Returns this phone's certificates if the setting wants TLS: no link becomes plain. */
    private TlsIdentity tls(int key) {
        if (!preferences.getBoolean(context.getString(key), false)) {
            return null;
        }
        TlsIdentity found = new PairingStore(context).certificates();
        if (found == null) {
            throw new IllegalArgumentException(context.getString(R.string.certificates_missing));
        }
        return found;
    }

    AirborneMode mode() {
        String wish = text(R.string.key_mode, R.string.default_mode);
        return context.getString(R.string.mode_black_box).equals(wish)
                ? AirborneMode.BLACK_BOX : AirborneMode.FLIGHT_CONTROLLER;
    }

    /** Returns whether sockets stay on the Wi-Fi in which the Raspberry Pi is found. */
    boolean isOnWifi() {
        return preferences.getBoolean(context.getString(R.string.key_on_wifi), false);
    }

    /** Returns the phone's mounting in the aeroplane; flat if the stored value is invalid. */
    Mounting mounting() {
        String kept = preferences.getString(context.getString(R.string.key_mounting), "");
        try {
            return kept.isEmpty() ? Mounting.FLAT : Mounting.fromText(kept);
        } catch (IllegalArgumentException broken) {
            RaspilotApplication.of(context).log(
                    context.getString(R.string.mounting_broken, broken.getMessage()));
            return Mounting.FLAT;
        }
    }

    void setMounting(Mounting mounting) {
        preferences.edit().putString(context.getString(R.string.key_mounting), mounting.toText())
                .apply();
    }

    Side nose() {
        String kept = preferences.getString(context.getString(R.string.key_nose), "");
        for (Side side : Side.values()) {
            if (side.name().equals(kept)) {
                return side;
            }
        }
        return Side.TOP;
    }

    void setNose(Side nose) {
        preferences.edit().putString(context.getString(R.string.key_nose), nose.name()).apply();
    }

    double referencePressureHPa() {
        String value = text(R.string.key_reference_pressure, R.string.default_reference_pressure);
        check(SettingRule.PRESSURE, value);
        return SettingRule.number(value);
    }

    void setReferencePressureHPa(double hPa) {
        preferences.edit().putString(context.getString(R.string.key_reference_pressure),
                String.format(Locale.ROOT, "%.2f", hPa)).apply();
    }

    /** Returns whether the screen stays on while the airborne screen is visible. */
    boolean isScreenKept() {
        return preferences.getBoolean(context.getString(R.string.key_keep_screen), false);
    }

    void setScreenKept(boolean isKept) {
        preferences.edit().putBoolean(context.getString(R.string.key_keep_screen), isKept)
                .apply();
    }

    private OrientationTransport transport() {
        String wish = text(R.string.key_orientation, R.string.default_orientation);
        for (OrientationTransport transport : OrientationTransport.values()) {
            if (transport.name().equals(wish)) {
                return transport;
            }
        }
        return OrientationTransport.TCP;
    }

    private String text(int key, int usual) {
        return preferences.getString(context.getString(key), context.getString(usual)).trim();
    }

    private int port(int key, int usual) {
        return whole(key, usual, SettingRule.PORT);
    }

    private int whole(int key, int usual, SettingRule rule) {
        String value = text(key, usual);
        check(rule, value);
        return Integer.parseInt(value);
    }

    private void check(SettingRule rule, String value) {
        if (!rule.holds(value)) {
            throw new IllegalArgumentException(context.getString(R.string.setting_broken,
                    value, context.getString(rule.sentence)));
        }
    }
}
