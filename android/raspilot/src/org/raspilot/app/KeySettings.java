package org.raspilot.app;

import android.app.Activity;
import android.app.AlertDialog;
import android.content.ActivityNotFoundException;
import android.content.Intent;
import android.preference.EditTextPreference;
import android.preference.Preference;
import android.preference.PreferenceCategory;
import android.widget.Toast;
import org.raspilot.up.android.PairingStore;
import org.raspilot.up.security.Pairing;

/** The keys on the settings screen: pair by a text or a scanner application, list, forget. */
final class KeySettings implements Preference.OnPreferenceChangeListener,
        Preference.OnPreferenceClickListener {
    /** The request code of the scanner. */
    static final int SCAN = 1;

    // The scanner applications' common interface, by ZXing.
    private static final String SCANNER = "com.google.zxing.client.android.SCAN";
    private static final String SCANNED = "SCAN_RESULT";
    /** Position of the keys, behind the two preferences that pair. */
    private static final int FIRST_KEY = 2;

    private final SettingsFragment fragment;
    private final PairingStore store;
    private final PreferenceCategory list;

    KeySettings(SettingsFragment fragment) {
        this.fragment = fragment;
        store = new PairingStore(fragment.getActivity());
        list = (PreferenceCategory) fragment.findPreference(text(R.string.key_keys));
        fragment.findPreference(text(R.string.key_pairing)).setOnPreferenceChangeListener(this);
        Preference scan = new Preference(fragment.getActivity());
        scan.setTitle(R.string.setting_scan);
        scan.setSummary(R.string.setting_scan_hint);
        scan.setOnPreferenceClickListener(clicked -> scan());
        list.addPreference(scan);
        showAll();
    }

    @Override
    public boolean onPreferenceChange(Preference preference, Object value) {
        pair(String.valueOf(value));
        // The text is secret: the settings do not keep it.
        return false;
    }

    /** Asks whether to forget the key that was clicked. */
    @Override
    public boolean onPreferenceClick(Preference clicked) {
        String aircraft = String.valueOf(clicked.getTitle());
        new AlertDialog.Builder(fragment.getActivity())
                .setMessage(text(R.string.forget_question, aircraft))
                .setPositiveButton(R.string.forget, (dialog, which) -> forget(aircraft))
                .setNegativeButton(android.R.string.cancel, null).show();
        return true;
    }

    /** Takes what a scanner returned; null: nothing. */
    void onScanned(Intent result) {
        String found = result == null ? null : result.getStringExtra(SCANNED);
        if (found != null) {
            pair(found);
        }
    }

    private boolean scan() {
        try {
            fragment.startActivityForResult(
                    new Intent(SCANNER).putExtra("SCAN_MODE", "QR_CODE_MODE"), SCAN);
        } catch (ActivityNotFoundException none) {
            tell(text(R.string.scan_none));
        }
        return true;
    }

    private void pair(String pasted) {
        Pairing pairing = Pairing.parse(pasted);
        if (pairing == null) {
            tell(text(R.string.pairing_invalid));
            return;
        }
        try {
            store.put(pairing);
        } catch (IllegalArgumentException fault) {
            tell(fault.getMessage());
            return;
        }
        tell(text(R.string.pairing_done, pairing.aircraft, pairing));
        ((EditTextPreference) fragment.findPreference(text(R.string.key_ground_aircraft)))
                .setText(pairing.aircraft);
        changed();
    }

    private void forget(String aircraft) {
        store.forget(aircraft);
        changed();
    }

    private void changed() {
        Activity window = fragment.getActivity();
        if (window != null) {
            showAll();
            TelemetryLink.of(window).reload();
        }
    }

    private void showAll() {
        while (list.getPreferenceCount() > FIRST_KEY) {
            list.removePreference(list.getPreference(FIRST_KEY));
        }
        for (String aircraft : store.aircraft()) {
            Preference key = new Preference(fragment.getActivity());
            key.setTitle(aircraft);
            key.setSummary(summary(aircraft));
            key.setOnPreferenceClickListener(this);
            list.addPreference(key);
        }
    }

    private String summary(String aircraft) {
        try {
            return text(PairingStore.isInKeystore() ? R.string.key_in_keystore
                    : R.string.key_in_storage, store.get(aircraft));
        } catch (IllegalArgumentException unreadable) {
            return unreadable.getMessage();
        }
    }

    private void tell(String words) {
        Toast.makeText(fragment.getActivity(), words, Toast.LENGTH_LONG).show();
    }

    private String text(int id, Object... values) {
        return fragment.getString(id, values);
    }
}
