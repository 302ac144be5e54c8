package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.wire.GeneralMessage;

/** The far end of a link: keeps the answers as "ack id" and "nack id code reason". */
final class Answers implements AnswerSink {
    private final List<String> heard = new ArrayList<>();

    @Override
    public void answer(GeneralMessage answer) {
        BaseCommand command = CommandRegistry.builtin().read(answer);
        if (command instanceof AckCommand) {
            heard.add("ack " + ((AckCommand) command).commandId);
        } else {
            NackCommand nack = (NackCommand) command;
            heard.add("nack " + nack.commandId + " " + nack.code + " " + nack.reason);
        }
    }

    /** Returns the messages since the last call. */
    List<String> heard() {
        List<String> all = new ArrayList<>(heard);
        heard.clear();
        return all;
    }
}
