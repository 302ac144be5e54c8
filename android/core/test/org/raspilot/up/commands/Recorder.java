package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.List;

/** A handler that records its Commands and throws on request. */
final class Recorder extends BaseCommandHandler {
    final List<BaseCommand> commands = new ArrayList<>();
    CommandRefusedException refusal;
    RuntimeException fault;

    @Override
    public void runAction(BaseCommand command) throws CommandRefusedException {
        commands.add(command);
        if (fault != null) {
            throw fault;
        }
        if (refusal != null) {
            throw refusal;
        }
    }
}
