package org.raspilot.app;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public final class AppLogTest {
    private final AppLog book = new AppLog();
    private int told;

    @Test
    public void linesAreKeptInTheirOrder() {
        book.add(1000, "connected");
        book.add(2000, "lost");
        assertEquals(2, book.entries().size());
        assertEquals("connected", book.entries().get(0).text);
        assertEquals("lost", book.newest().text);
        assertEquals(2000, book.newest().timeMs);
    }

    @Test
    public void theSameLineInARowIsCounted() {
        book.add(1000, "no runner");
        book.add(3000, "no runner");
        assertEquals(1, book.entries().size());
        assertEquals(2, book.newest().times);
        assertEquals(3000, book.newest().timeMs);
    }

    @Test
    public void theBookIsBounded() {
        for (int line = 0; line < AppLog.MAX_ENTRIES + 10; line++) {
            book.add(line, "line " + line);
        }
        assertEquals(AppLog.MAX_ENTRIES, book.entries().size());
        assertEquals("line 10", book.entries().get(0).text);
    }

    @Test
    public void watchersHearUntilTheyAreTakenAway() {
        AppLog.Watcher watcher = new AppLog.Watcher() {
            @Override
            public void onEvents() {
                told++;
                book.removeWatcher(this);
            }
        };
        book.addWatcher(watcher);
        book.addWatcher(watcher);
        book.add(1, "one");
        book.clear();
        assertEquals(1, told);
        assertNull(book.newest());
    }
}
