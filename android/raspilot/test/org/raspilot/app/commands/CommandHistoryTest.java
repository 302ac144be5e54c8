package org.raspilot.app.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public final class CommandHistoryTest {
    private final CommandHistory history = new CommandHistory();

    @Test
    public void whatWasSentWaitsForItsAnswer() {
        assertNull(history.newest());
        int number = history.sent("Arm", 100);
        assertEquals(CommandHistory.Outcome.WAITING, history.newest().outcome);
        history.answered(number, CommandHistory.Outcome.REFUSED, "no", 40L);
        assertEquals(CommandHistory.Outcome.REFUSED, history.newest().outcome);
        assertEquals("no", history.newest().reason);
        assertEquals("Arm", history.newest().words);
        assertEquals(100, history.newest().atMs);
    }

    @Test
    public void anAnswerFindsItsOwnCommand() {
        int first = history.sent("one", 1);
        history.sent("two", 2);
        history.answered(first, CommandHistory.Outcome.GOOD, "", 40L);
        assertEquals(CommandHistory.Outcome.WAITING, history.entries().get(0).outcome);
        assertEquals(CommandHistory.Outcome.GOOD, history.entries().get(1).outcome);
    }

    @Test
    public void theOldestAreForgottenAndTheirAnswersToo() {
        int first = history.sent("first", 0);
        for (int each = 0; each < CommandHistory.MAX_ENTRIES; each++) {
            history.sent("another", each);
        }
        assertEquals(CommandHistory.MAX_ENTRIES, history.entries().size());
        history.answered(first, CommandHistory.Outcome.GOOD, "", null);
        for (CommandHistory.Entry entry : history.entries()) {
            assertEquals(CommandHistory.Outcome.WAITING, entry.outcome);
        }
    }
}
