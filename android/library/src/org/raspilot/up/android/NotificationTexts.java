package org.raspilot.up.android;

import android.app.Activity;

/** The texts and icons of the notification of the application's service. */
public final class NotificationTexts {
    final int icon;
    final int stopIcon;
    final String channel;
    final String channelName;
    final String title;
    final String stop;
    final Class<? extends Activity> screen;

    /**
     * Takes them.
     *
     * @param icon a drawable: white on transparent
     * @param stopIcon the drawable of the button that stops
     * @param channel the channel's name inside the system, from Android 8 on; never changes
     * @param channelName what the user reads as the channel's name
     * @param stop the label of the stop button
     * @param screen what a touch opens
     */
    public NotificationTexts(int icon, int stopIcon, String channel, String channelName,
            String title, String stop, Class<? extends Activity> screen) {
        this.icon = icon;
        this.stopIcon = stopIcon;
        this.channel = channel;
        this.channelName = channelName;
        this.title = title;
        this.stop = stop;
        this.screen = screen;
    }
}
