package org.raspilot.app;

import static org.junit.Assert.assertEquals;

import java.text.SimpleDateFormat;
import java.util.Locale;
import java.util.TimeZone;
import org.junit.Test;

public final class LogFormatterTest {
    @Test
    public void aLineHasItsTimeAndHowOften() {
        SimpleDateFormat format = new SimpleDateFormat("HH:mm:ss", Locale.US);
        format.setTimeZone(TimeZone.getTimeZone("UTC"));
        LogFormatter text = new LogFormatter(format, (line, times) -> line + " x" + times);
        AppLog book = new AppLog();
        book.add(3723000, "connected");
        book.add(3724000, "lost");
        book.add(3725000, "lost");
        assertEquals("01:02:03  connected\n01:02:05  lost x2\n", text.all(book.entries()));
    }
}
