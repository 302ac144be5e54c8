package org.raspilot.app;

import android.app.Activity;
import android.app.AlertDialog;
import android.content.ActivityNotFoundException;
import android.content.Intent;
import android.preference.EditTextPreference;
import android.preference.Preference;
import android.preference.PreferenceCategory;
import android.widget.Toast;
import java.io.IOException;
import java.io.InputStream;
import org.raspilot.up.android.PairingStore;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsIdentity;

/**
 * The keys on the settings screen: pair by a text or a scanner application, list, forget; choose
 * the file of the certificates for TLS.
 */
final class KeySettings {
    static final int SCAN = 1;
    static final int FILE = 2;

    // The scanner applications' common interface, by ZXing.
    private static final String SCANNER = "com.google.zxing.client.android.SCAN";
    private static final String SCANNED = "SCAN_RESULT";
    /** Position of the keys, behind the preferences that are always there. */
    private static final int FIRST_KEY = 3;
    private static final int MAX_BYTES = 65536;

    private final SettingsFragment fragment;
    private final PairingStore store;
    private final PreferenceCategory list;
    private final Preference certificates;

    KeySettings(SettingsFragment fragment) {
        this.fragment = fragment;
        store = new PairingStore(fragment.getActivity());
        list = (PreferenceCategory) fragment.findPreference(text(R.string.key_keys));
        fragment.findPreference(text(R.string.key_pairing)).setOnPreferenceChangeListener(
                (preference, value) -> pair(String.valueOf(value)));
        certificates = fragment.findPreference(text(R.string.key_certificates));
        certificates.setOnPreferenceClickListener(clicked -> onCertificates());
        Preference scan = new Preference(fragment.getActivity());
        scan.setTitle(R.string.setting_scan);
        scan.setSummary(R.string.setting_scan_hint);
        scan.setOnPreferenceClickListener(clicked -> scan());
        list.addPreference(scan);
        showAll();
    }

    /** Chooses the file of certificates, or asks whether to forget those that are kept. */
    private boolean onCertificates() {
        if (text(R.string.certificates_none).contentEquals(certificates.getSummary())) {
            start(new Intent(Intent.ACTION_GET_CONTENT).setType("*/*")
                    .addCategory(Intent.CATEGORY_OPENABLE), FILE, R.string.certificates_no_files);
        } else {
            ask(text(R.string.certificates_forget), () -> store.forgetCertificates());
        }
        return true;
    }

    /** Takes the file that was chosen; null: none. */
    void onChosen(Intent result) {
        if (result == null || result.getData() == null) {
            return;
        }
        byte[] bytes = new byte[MAX_BYTES];
        int size = 0;
        try {
            InputStream file =
                    fragment.getActivity().getContentResolver().openInputStream(result.getData());
            if (file == null) {
                throw new IOException("the other application has ended");
            }
            try {
                for (int read = 0; read >= 0 && size < MAX_BYTES;
                        read = file.read(bytes, size, MAX_BYTES - size)) {
                    size += read;
                }
            } finally {
                file.close();
            }
            if (size == MAX_BYTES) {
                throw new IOException("the file is too large");
            }
            store.putCertificates(new String(bytes, 0, size, "US-ASCII"));
        } catch (IllegalArgumentException wrong) {
            tell(wrong.getMessage());
        } catch (IOException | SecurityException unreadable) {
            // Another application supplies the file.
            tell(text(R.string.certificates_unread));
        }
        changed();
    }

    /** Takes what a scanner returned; null: nothing. */
    void onScanned(Intent result) {
        String found = result == null ? null : result.getStringExtra(SCANNED);
        if (found != null) {
            pair(found);
        }
    }

    private boolean scan() {
        start(new Intent(SCANNER).putExtra("SCAN_MODE", "QR_CODE_MODE"), SCAN, R.string.scan_none);
        return true;
    }

    private void start(Intent wish, int request, int without) {
        try {
            fragment.startActivityForResult(wish, request);
        } catch (ActivityNotFoundException none) {
            tell(text(without));
        }
    }

    private boolean ask(String question, Runnable forget) {
        new AlertDialog.Builder(fragment.getActivity())
                .setMessage(question)
                .setPositiveButton(R.string.forget, (dialog, which) -> {
                    forget.run();
                    changed();
                })
                .setNegativeButton(android.R.string.cancel, null).show();
        return true;
    }

    /** Returns false: the text is secret, so the settings do not keep it. */
    private boolean pair(String pasted) {
        Pairing pairing = Pairing.parse(pasted);
        if (pairing == null) {
            tell(text(R.string.pairing_invalid));
            return false;
        }
        try {
            store.put(pairing);
        } catch (IllegalArgumentException fault) {
            tell(fault.getMessage());
            return false;
        }
        tell(text(R.string.pairing_done, pairing.aircraft, pairing));
        ((EditTextPreference) fragment.findPreference(text(R.string.key_ground_aircraft)))
                .setText(pairing.aircraft);
        changed();
        return false;
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
            key.setOnPreferenceClickListener(clicked ->
                    ask(text(R.string.forget_question, aircraft), () -> store.forget(aircraft)));
            list.addPreference(key);
        }
        certificates.setSummary(certificates());
    }

    private String certificates() {
        try {
            TlsIdentity found = store.certificates();
            return found == null ? text(R.string.certificates_none) : found.toString();
        } catch (IllegalArgumentException unreadable) {
            return text(R.string.certificates_broken);
        }
    }

    private String summary(String aircraft) {
        try {
            return text(PairingStore.isInKeystore() ? R.string.key_in_keystore
                    : R.string.key_in_storage, store.get(aircraft));
        } catch (IllegalArgumentException unreadable) {
            return text(R.string.key_broken);
        }
    }

    private void tell(String words) {
        Toast.makeText(fragment.getActivity(), words, Toast.LENGTH_LONG).show();
    }

    private String text(int id, Object... values) {
        return fragment.getString(id, values);
    }
}
