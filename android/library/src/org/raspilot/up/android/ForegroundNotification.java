package org.raspilot.up.android;

import android.app.Notification;
import android.app.NotificationManager;
import android.app.PendingIntent;
import android.app.Service;
import android.content.Context;
import android.content.Intent;
import android.os.Build;
import org.raspilot.up.android.api23.Api23;
import org.raspilot.up.android.api26.Foreground;
import org.raspilot.up.android.api29.TypedForeground;

/** The ongoing notification of a service in the foreground, with what stops it. */
final class ForegroundNotification {
    private static final int ID = 1;

    private final Service service;
    private final NotificationTexts texts;
    private String shown;

    ForegroundNotification(Service service, NotificationTexts texts) {
        this.service = service;
        this.texts = texts;
    }

    void begin(String text, boolean usesLocation) {
        shown = text;
        if (Build.VERSION.SDK_INT >= 29 && usesLocation) {
            TypedForeground.start(service, ID, notification(text));
        } else {
            service.startForeground(ID, notification(text));
        }
    }

    /** Shows another text; the same one again without effect. */
    void show(String text) {
        NotificationManager manager = (NotificationManager)
                service.getSystemService(Context.NOTIFICATION_SERVICE);
        if (manager != null && !text.equals(shown)) {
            shown = text;
            manager.notify(ID, notification(text));
        }
    }

    private Notification notification(String text) {
        return builder()
                .setSmallIcon(texts.icon)
                .setContentTitle(texts.title)
                .setContentText(text)
                .setContentIntent(screen())
                .addAction(texts.stopIcon, texts.stop, stop())
                .setOngoing(true)
                .setOnlyAlertOnce(true)
                .build();
    }

    @SuppressWarnings("deprecation")
    private Notification.Builder builder() {
        if (Build.VERSION.SDK_INT >= 26) {
            return Foreground.builder(service, texts.channel, texts.channelName);
        }
        return new Notification.Builder(service).setPriority(Notification.PRIORITY_LOW);
    }

    private PendingIntent screen() {
        Intent intent = new Intent(service, texts.screen)
                .addFlags(Intent.FLAG_ACTIVITY_SINGLE_TOP);
        return PendingIntent.getActivity(service, 0, intent, flags());
    }

    private PendingIntent stop() {
        Intent intent = new Intent(service, service.getClass())
                .setAction(BaseUpService.ACTION_STOP);
        return PendingIntent.getService(service, 0, intent, flags());
    }

    private static int flags() {
        int flags = PendingIntent.FLAG_UPDATE_CURRENT;
        return Build.VERSION.SDK_INT >= 23 ? flags | Api23.immutableFlag() : flags;
    }
}
