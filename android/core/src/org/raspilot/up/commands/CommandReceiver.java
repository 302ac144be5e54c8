package org.raspilot.up.commands;

import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.MalformedException;

/**
 * The mediator between a link and the bus: reads, validates, executes, answers (thesis 4.1.4).
 *
 * <p>A Command with an id is answered once; the same id with the same content is answered again
 * and not executed again (the newest 256 ids of 60 s of a link). Source: docs/protocols.md 4.
 */
public final class CommandReceiver {
    /** Makes a receiver for the links of one loop. */
    public CommandReceiver(CommandRegistry registry, CommandExecutor executor, Loop loop) {
    }

    /** Takes one line of a link, without its line end. */
    public void receiveLine(byte[] line, int length, AnswerSink answers) {
    }

    /** Takes one message of a link. */
    public void receive(GeneralMessage message, AnswerSink answers) {
    }

    /** Counts a line that is no General Message; refuses it when its id could be read. */
    public void receiveMalformed(MalformedException malformed, AnswerSink answers) {
    }

    /**
     * Returns how many messages came to an end: {@code received}, {@code repeated} or the word
     * of a {@link NackCode}.
     */
    public long count(String what) {
        return 0;
    }
}
