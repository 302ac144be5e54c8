package org.raspilot.up.commands;

import java.util.UUID;

/**
 * The bus: delivers every Command to those who subscribed to it (thesis 4.1.4).
 *
 * <p>Used on the loop thread only. A Command executed from inside a handler waits until the
 * current Command's handlers are done.
 */
public final class CommandExecutor {
    /** Makes a bus; the listener is told of handlers that fail. */
    public CommandExecutor(CommandRegistry registry, HandlerFaultListener faults) {
    }

    /**
     * Subscribes a handler to a Command by its name or alias and returns the handle that ends it;
     * one handler may be registered several times.
     */
    public UUID registerCommand(String name, BaseCommandHandler handler) {
        return UUID.randomUUID();
    }

    /** Ends a subscription; false: the handle is none of that Command. */
    public boolean unregisterCommand(String name, UUID handle) {
        return false;
    }

    /** Says whether anybody subscribed to a Command. */
    public boolean hasHandlers(String name) {
        return false;
    }

    /**
     * Delivers a Command to its handlers in the order of their registration and returns how many
     * they are; no handler's fault or refusal reaches the caller or the other handlers.
     */
    public int executeCommand(BaseCommand command) {
        return 0;
    }

    /** Returns how often a handler failed, refusals not counted. */
    public long failedHandlers() {
        return 0;
    }
}
