package org.raspilot.app;

import android.app.Activity;
import android.app.AlertDialog;
import android.content.ActivityNotFoundException;
import android.content.Intent;
import android.net.Uri;
import android.preference.Preference;
import android.widget.Toast;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.text.DateFormat;
import org.raspilot.up.android.CertificateStore;
import org.raspilot.up.tls.TlsIdentity;

/** The certificates for TLS on the settings screen: choose their file, show them, forget them. */
final class CertificateSettings {
    /** The request code of the choice of a file. */
    static final int FILE = 2;

    private static final int MAX_BYTES = 65536;

    private final SettingsFragment fragment;
    private final CertificateStore store;
    private final Preference shown;

    CertificateSettings(SettingsFragment fragment) {
        this.fragment = fragment;
        store = new CertificateStore(fragment.getActivity());
        shown = fragment.findPreference(fragment.getString(R.string.key_certificate));
        shown.setOnPreferenceClickListener(clicked -> onClick());
        show();
    }

    /** Takes the file that was chosen; null: none. */
    void onChosen(Intent result) {
        Uri file = result == null ? null : result.getData();
        if (file == null) {
            return;
        }
        try {
            store.put(read(file));
        } catch (IOException | IllegalArgumentException | SecurityException fault) {
            tell(fault.getMessage());
        }
        changed();
    }

    private boolean onClick() {
        if (isKept()) {
            new AlertDialog.Builder(fragment.getActivity())
                    .setMessage(R.string.certificate_forget)
                    .setPositiveButton(R.string.forget, (dialog, which) -> {
                        store.forget();
                        changed();
                    })
                    .setNegativeButton(android.R.string.cancel, null).show();
            return true;
        }
        try {
            fragment.startActivityForResult(new Intent(Intent.ACTION_GET_CONTENT).setType("*/*")
                    .addCategory(Intent.CATEGORY_OPENABLE), FILE);
        } catch (ActivityNotFoundException none) {
            tell(fragment.getString(R.string.certificate_no_files));
        }
        return true;
    }

    private boolean isKept() {
        try {
            return store.get() != null;
        } catch (IllegalArgumentException unreadable) {
            return true;
        }
    }

    private String read(Uri file) throws IOException {
        ByteArrayOutputStream text = new ByteArrayOutputStream();
        byte[] bytes = new byte[MAX_BYTES];
        InputStream content = fragment.getActivity().getContentResolver().openInputStream(file);
        if (content == null) {
            throw new IOException(fragment.getString(R.string.certificate_no_files));
        }
        try {
            int length = content.read(bytes);
            while (length > 0 && text.size() <= MAX_BYTES) {
                text.write(bytes, 0, length);
                length = content.read(bytes);
            }
        } finally {
            content.close();
        }
        return text.toString("US-ASCII");
    }

    private void changed() {
        Activity window = fragment.getActivity();
        if (window != null) {
            show();
            TelemetryLink.of(window).reload();
        }
    }

    private void show() {
        try {
            TlsIdentity found = store.get();
            if (found == null) {
                shown.setSummary(R.string.certificate_none);
            } else if (found.notAfter() == null) {
                shown.setSummary(R.string.certificate_ca);
            } else {
                shown.setSummary(fragment.getString(R.string.certificate_of, found.name,
                        DateFormat.getDateInstance().format(found.notAfter())));
            }
        } catch (IllegalArgumentException unreadable) {
            shown.setSummary(unreadable.getMessage());
        }
    }

    private void tell(String words) {
        Toast.makeText(fragment.getActivity(), words, Toast.LENGTH_LONG).show();
    }
}
