package org.raspilot.app;

import android.preference.PreferenceFragment;

/** The settings screen. */
public final class SettingsFragment extends PreferenceFragment {
}
