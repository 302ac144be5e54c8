package org.raspilot.app;

import android.content.Intent;
import android.content.SharedPreferences;
import android.os.Bundle;
import android.preference.EditTextPreference;
import android.preference.ListPreference;
import android.preference.Preference;
import android.preference.PreferenceFragment;
import android.widget.Toast;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * The settings screen: each value is judged before it is kept, refused with a sentence, and shown
 * under its title.
 */
public final class SettingsFragment extends PreferenceFragment
        implements SharedPreferences.OnSharedPreferenceChangeListener,
        Preference.OnPreferenceChangeListener {
    private static final String GROUND = "ground_";

    private final Map<String, SettingRule> rules = new LinkedHashMap<>();
    private KeySettings keys;

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        addPreferencesFromResource(R.xml.preferences);
        rule(R.string.key_host, SettingRule.HOST_OR_NOTHING);
        rule(R.string.key_general_port, SettingRule.PORT);
        rule(R.string.key_orientation_port, SettingRule.PORT);
        rule(R.string.key_discovery_port, SettingRule.PORT);
        rule(R.string.key_runner_host, SettingRule.HOST_OR_NOTHING);
        rule(R.string.key_runner_port, SettingRule.PORT);
        rule(R.string.key_aircraft, SettingRule.AIRCRAFT);
        rule(R.string.key_profile, SettingRule.PROFILE);
        rule(R.string.key_orientation_hz, SettingRule.RATE);
        rule(R.string.key_reference_pressure, SettingRule.PRESSURE);
        rule(R.string.key_ground_host, SettingRule.HOST_OR_NOTHING);
        rule(R.string.key_ground_port, SettingRule.PORT);
        rule(R.string.key_ground_aircraft, SettingRule.AIRCRAFT);
        keys = new KeySettings(this);
        showAll();
    }

    @Override
    public void onActivityResult(int request, int result, Intent data) {
        if (request == KeySettings.SCAN) {
            keys.onScanned(data);
        } else if (request == KeySettings.FILE) {
            keys.onChosen(data);
        }
    }

    @Override
    public void onStart() {
        super.onStart();
        getPreferenceManager().getSharedPreferences()
                .registerOnSharedPreferenceChangeListener(this);
        showAll();
    }

    @Override
    public void onStop() {
        getPreferenceManager().getSharedPreferences()
                .unregisterOnSharedPreferenceChangeListener(this);
        super.onStop();
    }

    @Override
    public boolean onPreferenceChange(Preference preference, Object value) {
        SettingRule rule = rules.get(preference.getKey());
        if (rule == null || rule.holds(String.valueOf(value).trim())) {
            return true;
        }
        Toast.makeText(getActivity(), rule.sentence, Toast.LENGTH_LONG).show();
        return false;
    }

    @Override
    public void onSharedPreferenceChanged(SharedPreferences preferences, String key) {
        showAll();
        if (getString(R.string.key_theme).equals(key)) {
            getActivity().recreate();
        } else if (key != null && key.startsWith(GROUND)) {
            TelemetryLink.of(getActivity()).reload();
        }
    }

    private void rule(int key, SettingRule rule) {
        rules.put(getString(key), rule);
        findPreference(getString(key)).setOnPreferenceChangeListener(this);
    }

    private void showAll() {
        for (String key : rules.keySet()) {
            EditTextPreference preference = (EditTextPreference) findPreference(key);
            String value = preference.getText();
            preference.setSummary(summary(key, value == null ? "" : value.trim()));
        }
        showChoice(R.string.key_mode);
        showChoice(R.string.key_orientation);
        showChoice(R.string.key_theme);
    }

    private void showChoice(int key) {
        ListPreference preference = (ListPreference) findPreference(getString(key));
        preference.setSummary(preference.getEntry());
    }

    private String summary(String key, String value) {
        if (key.equals(getString(R.string.key_orientation_hz))) {
            return getString(R.string.setting_summary_hz, value);
        }
        if (key.equals(getString(R.string.key_reference_pressure))) {
            return getString(R.string.setting_summary_hpa, value);
        }
        if (!value.isEmpty()) {
            return value;
        }
        if (key.equals(getString(R.string.key_host))) {
            return getString(R.string.setting_host_none);
        }
        if (key.equals(getString(R.string.key_runner_host))) {
            return getString(R.string.setting_runner_host_none);
        }
        return getString(key.equals(getString(R.string.key_profile))
                ? R.string.setting_profile_none : R.string.setting_ground_host_none);
    }
}
