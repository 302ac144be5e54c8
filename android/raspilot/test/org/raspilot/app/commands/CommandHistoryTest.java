package org.raspilot.app.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public final class CommandHistoryTest {
    private final CommandHistory history = new CommandHistory();

    @Test
    public void theNewestIsFirstAndTheOldestAreForgotten() {
        assertNull(history.newest());
        for (int each = 0; each <= CommandHistory.MAX_ENTRIES; each++) {
            history.sent("command " + each, each);
        }
        assertEquals(CommandHistory.MAX_ENTRIES, history.entries().size());
        assertEquals("command 50", history.newest().words);
        assertEquals(50, history.newest().atMs);
        assertEquals("command 1", history.entries().get(49).words);
    }
}
