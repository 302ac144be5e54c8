package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.commands.CommandReceiver.AnswerSink;
import org.raspilot.up.wire.GeneralMessage;

/** The far end of a link: keeps the answers as "ack id" and "nack id code reason". */
final class Answers implements AnswerSink {
    private final List<String> heard = new ArrayList<>();

    @Override
    public void answer(GeneralMessage answer) {
        BaseCommand command = CommandRegistry.builtin().read(answer);
        heard.add(command.name().equals(Commands.ACK) ? "ack " + command.data().get("id")
                : "nack " + command.data().get("id") + " " + command.data().get("code") + " "
                + command.data().get("reason"));
    }

    /** Returns the messages since the last call. */
    List<String> heard() {
        List<String> all = new ArrayList<>(heard);
        heard.clear();
        return all;
    }
}
