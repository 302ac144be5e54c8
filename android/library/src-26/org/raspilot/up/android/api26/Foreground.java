package org.raspilot.up.android.api26;

import android.app.Notification;
import android.app.NotificationChannel;
import android.app.NotificationManager;
import android.content.Context;
import android.content.Intent;

/** Services in the foreground and the channels of their notifications (API 26). */
public final class Foreground {
    private Foreground() {
    }

    /** Starts a service that promises to be in the foreground within 5 s. */
    public static void start(Context context, Intent service) {
        context.startForegroundService(service);
    }

    /** Creates or renames the channel, silent and without a badge, and a builder for it. */
    public static Notification.Builder builder(Context context, String channel, String name) {
        NotificationManager manager = (NotificationManager)
                context.getSystemService(Context.NOTIFICATION_SERVICE);
        if (manager != null) {
            NotificationChannel made = new NotificationChannel(channel, name,
                    NotificationManager.IMPORTANCE_LOW);
            made.setShowBadge(false);
            manager.createNotificationChannel(made);
        }
        return new Notification.Builder(context, channel);
    }
}
