package org.raspilot.app;

import java.text.DateFormat;
import java.util.Date;
import java.util.List;

/** Writes lines of the log as text. */
final class LogFormatter {
    /** Writes how often something happened: its text and a number. */
    interface Times {
        /** Returns the text of a line that happened more than once. */
        String of(String text, int times);
    }

    private final DateFormat format;
    private final Times times;

    LogFormatter(DateFormat format, Times times) {
        this.format = format;
        this.times = times;
    }

    /** Returns one line: its time and what happened. */
    String line(AppLog.Entry entry) {
        String text = entry.times == 1 ? entry.text
                : times.of(entry.text, entry.times);
        return format.format(new Date(entry.timeMs)) + "  " + text;
    }

    String all(List<AppLog.Entry> entries) {
        StringBuilder text = new StringBuilder();
        for (AppLog.Entry entry : entries) {
            text.append(line(entry)).append('\n');
        }
        return text.toString();
    }
}
