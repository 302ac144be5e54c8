package org.raspilot.up.android;

import android.app.Activity;

/** The texts of the notification of the application's service. */
public interface NotificationTexts {
    /** Returns a drawable: white on transparent. */
    int icon();

    /** Returns the drawable of the button that stops. */
    int stopIcon();

    /** Returns the name of the channel inside the system, from Android 8 on; never changes. */
    String channel();

    /** Returns what the user reads as the channel's name. */
    String channelName();

    String title();

    /** Returns the label of the stop button. */
    String stop();

    /** Returns the screen that a touch opens. */
    Class<? extends Activity> screen();
}
