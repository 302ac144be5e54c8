package org.raspilot.up.commands;

/** Receives the failures of handlers; the other handlers and the link continue. */
public interface HandlerFaultListener {
    /** Called on the loop thread with an exception of a handler that is not a refusal. */
    void onHandlerFailed(CommandHandler handler, BaseCommand command, Throwable fault);
}
