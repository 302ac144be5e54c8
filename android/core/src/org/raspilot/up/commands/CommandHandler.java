package org.raspilot.up.commands;

/** The action of a Command; register it with {@link CommandExecutor#registerCommand}. */
public interface CommandHandler {
    /**
     * Executes the Command, on the loop thread, without blocking.
     *
     * @throws CommandRefusedException to refuse it with a reason for the sender
     */
    void runAction(BaseCommand command) throws CommandRefusedException;
}
