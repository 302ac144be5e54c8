package org.raspilot.app;

import android.content.Context;
import android.content.SharedPreferences;
import android.content.res.Configuration;
import android.preference.PreferenceManager;

/** Chooses the theme: dark, daylight, or as the system has it at this hour. */
final class AppTheme {
    private static final String DARK = "dark";
    private static final String DAYLIGHT = "daylight";

    private AppTheme() {
    }

    /** Returns the style that an activity sets before it is created. */
    static int style(Context context) {
        SharedPreferences preferences = PreferenceManager.getDefaultSharedPreferences(context);
        String wish = preferences.getString(context.getString(R.string.key_theme), "");
        return isDark(wish, context.getResources().getConfiguration().uiMode)
                ? R.style.Theme_Raspilot_Dark : R.style.Theme_Raspilot_Daylight;
    }

    /** Returns whether a setting (`dark`, `daylight`, otherwise the uiMode's) is a dark theme. */
    static boolean isDark(String wish, int uiMode) {
        if (DARK.equals(wish) || DAYLIGHT.equals(wish)) {
            return DARK.equals(wish);
        }
        int night = uiMode & Configuration.UI_MODE_NIGHT_MASK;
        return night == Configuration.UI_MODE_NIGHT_YES;
    }
}
