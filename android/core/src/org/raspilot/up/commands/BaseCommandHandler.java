package org.raspilot.up.commands;

/**
 * The action of a Command as an object (thesis 4.1.4); register it with
 * {@link CommandExecutor#registerCommand}.
 */
public abstract class BaseCommandHandler {
    /**
     * Carries the Command out, on the loop thread, without blocking.
     *
     * @throws CommandRefusedException to refuse it with a reason for the asker
     */
    public abstract void runAction(BaseCommand command) throws CommandRefusedException;
}
